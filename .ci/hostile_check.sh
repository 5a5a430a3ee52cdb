#!/usr/bin/env bash
# What a stranger may send, each through its stage with 1 GB of memory and 5 s of CPU: it is refused by a message, or
# read, and nothing else happens. The small files lie in fixtures/hostile; what would be large is made here.
#
# The executables have to be on the PATH. With UPDATE=1 memory and CPU of each are written to docs/hostile.md (needs
# GNU time).
set -euo pipefail
cd "$(dirname "$0")/../fixtures/hostile"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

# expect CODE WORDS COMMAND...: its exit code, and words that its message holds (an empty string: none are looked for).
expect() {
    local code=$1 words=$2 found=0 timer=()
    shift 2
    [ -z "${UPDATE:-}" ] || timer=(/usr/bin/time -f '%M %U' -o "$scratch/peak")
    (
        ulimit -v 1048576 -t 5
        exec "${timer[@]}" "$@"
    ) > "$scratch/out" 2> "$scratch/said" || found=$?
    if [ "$found" != "$code" ] || ! grep -qF -- "$words" <(cat "$scratch/said"; echo) || grep -q panicked "$scratch/said"; then
        echo "FAILED: $* ended with $found, not $code, or does not say \`$words\`:" >&2
        head -c 600 "$scratch/said" >&2
        failures=$((failures + 1))
    elif [ -n "${UPDATE:-}" ]; then
        local memory time
        read -r memory time < <(tail -n 1 "$scratch/peak")
        printf '| `%s` | %s | %s | %.1f |\n' "${*//"$scratch/"/}" "$code" $((memory / 1024)) "$time" >> "$scratch/table"
    fi
}

# Pictures.
expect 1 'pixels are more than the' perceive frame-large-jpeg.jsonl
expect 1 'pixels are more than the' perceive frame-large-png.jsonl
expect 1 'a JPEG without its end' perceive frame-cut-jpeg.jsonl
expect 1 'bytes that are taken of a picture file' perceive frame-endless.jsonl

# Homes.
echo 'the mug is on the table in the kitchen' | chunk | ground > "$scratch/grounded.jsonl"
plan --map sound.map.json "$scratch/grounded.jsonl" > "$scratch/planned.jsonl"
expect 1 'are these millimetres?' plan --map millimetres.map.json "$scratch/grounded.jsonl"
expect 1 'none beyond 100000' plan --map endless.map.json "$scratch/grounded.jsonl"
expect 1 'none beyond 100000' plan --map beyond.map.json "$scratch/grounded.jsonl"
expect 0 '' plan --map largest.map.json "$scratch/grounded.jsonl"
expect 1 'bytes that are taken of a room map' plan --map /dev/zero "$scratch/grounded.jsonl"
expect 1 'image: /dev/zero' plan --map endless.yaml "$scratch/grounded.jsonl"
expect 1 'cells are more than the' plan --map huge-map.yaml "$scratch/grounded.jsonl"
for world in negative-noise huge-noise; do
    expect 1 'noise: `slip`' drive --world "$world.scene.json" "$scratch/planned.jsonl"
done
expect 1 'bytes that are taken of a mesh file' drive --world endless-mesh.scene.json "$scratch/planned.jsonl"
cp layers.scene.json sound.map.json "$scratch"
python3 - "$scratch" << 'END'
import json, pathlib, sys

scratch = pathlib.Path(sys.argv[1])
faces = "".join(f"v 0 0 {i / 1e6}\nv 1 0 {i / 1e6}\nv 1 1 {i / 1e6}\nf -3 -2 -1\n" for i in range(20_000))
scratch.joinpath("layers.obj").write_text(faces + "v 1 1 1\nf -1 1 2\n")

room = lambda i: {"name": f"room{i}", "outline": [[x + i % 28 * 5, y + i // 28 * 5] for x, y in ((0, 0), (5, 0), (5, 5), (0, 5))]}
named = lambda rooms: [{**rooms[0], "name": "kitchen"}, *rooms[1:]]
home = lambda rooms: {"version": 1, "name": "m", "start": {"x": 1, "y": 1, "heading": 0}, "rooms": named(rooms), "doors": []}
scratch.joinpath("rooms.map.json").write_text(json.dumps(home([room(i) for i in range(700)])))
scratch.joinpath("most-rooms.map.json").write_text(json.dumps(home([room(i) for i in range(200)])))

pieces = [{"id": f"t{i}", "category": "stool", "x": 0.5 + i % 30, "y": 0.5 + i // 30} for i in range(1000)]
scratch.joinpath("pieces.scene.json").write_text(json.dumps({"version": 1, "name": "m", "map": "sound", "furniture": pieces}))

scratch.joinpath("deep.xml").write_text("<T><S>" + "<OBTP>" * 100_000)
scratch.joinpath("long.xml").write_text("<T>" + "<S>the/DT mug/NN</S>\n" * 200_000 + "</T>")

width = 4000
row = bytes(254 * (x % 2) for x in range(width))
scratch.joinpath("checkered.pgm").write_bytes(b"P5 %d %d 255\n" % (width, width) + (row + row[::-1]) * (width // 2))
scratch.joinpath("checkered.yaml").write_text(
    "image: checkered.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")

ring = [[x, y] for i in range(60_000) for x, y in ((i, 0), (i + 0.5, 1e5))] + [[60_000, -1], [0, -1], [0, 0]]
shape = {"type": "Polygon", "coordinates": [ring]}
square = {"type": "Polygon", "coordinates": [[[-9, 0], [-8, 0], [-8, 1], [-9, 0]]]}
scratch.joinpath("corners.jsonl").write_text(json.dumps({"a": {"type": "Polygon", "coordinates": [ring * 2]}, "b": square}) + "\n")
END
expect 1 'times the area of the box' drive --world "$scratch/layers.scene.json" "$scratch/planned.jsonl"
expect 1 'rooms are more than the' plan --map "$scratch/rooms.map.json" "$scratch/grounded.jsonl"
expect 0 '' plan --map "$scratch/most-rooms.map.json" "$scratch/grounded.jsonl"
expect 1 'pieces of furniture are more than the' drive --world "$scratch/pieces.scene.json" "$scratch/planned.jsonl"
expect 1 'inner walls are more than the' plan --map "$scratch/checkered.yaml" "$scratch/grounded.jsonl"

# Shapes and lines.
expect 1 'corners are more than the' hof "$scratch/corners.jsonl"
expect 3 'overlap or share a border' hof --keep-going shapes.jsonl
expect 1 'longer than the' chunk /dev/zero
expect 1 'longer than the' hof /dev/zero

# What others wrote about sentences.
import=(evaluate import ../import/treebank.xml --groundings)
expect 0 '' "${import[@]}" stray-cell.xlsx
expect 1 'cells are more than the' "${import[@]}" string-count.xlsx
expect 1 'is no cell' "${import[@]}" cell-name.xlsx
expect 1 'are taken of a spreadsheet, unpacked' "${import[@]}" unpacked.xlsx
expect 1 'levels are more than the' evaluate import "$scratch/deep.xml"
expect 0 '' evaluate import "$scratch/long.xml"
expect 1 'bytes that are taken of a treebank' evaluate import /dev/zero

# Logs.
python3 - "$scratch" << 'END'
import pathlib, struct, sys

# The same chunk forty times: each alone is within its bounds.
for name in ("many-messages", "large-message"):
    log, at = pathlib.Path(f"{name}.mcap").read_bytes(), 8
    repeated = log[:8]
    while at + 9 <= len(log) - 8:
        (length,) = struct.unpack("<Q", log[at + 1 : at + 9])
        record, at = log[at : at + 9 + length], at + 9 + length
        repeated += record * (40 if record[0] == 6 else 1) if record[0] in (1, 3, 4, 6) else b""
    end = bytes([15]) + struct.pack("<Q", 4) + bytes(4) + bytes([2]) + struct.pack("<Q", 20) + bytes(20)
    pathlib.Path(sys.argv[1], f"{name}.mcap").write_bytes(repeated + end + log[:8])
END
for log in many-messages.mcap "$scratch/many-messages.mcap"; do
    expect 3 'messages are more than the' drive --from "$log"
    expect 3 'messages are more than the' drive --from "$log" --recover
done
expect 3 'bytes are more than the' drive --from large-message.mcap
expect 3 'unpacked bytes for each packed one' drive --from "$scratch/large-message.mcap"
expect 3 'no frame in this log' perceive large-message.mcap

[ "$failures" = 0 ] || exit 1
if [ -n "${UPDATE:-}" ]; then
    {
        echo "# What hostile files cost"
        echo
        echo "Made by \`UPDATE=1 .ci/hostile_check.sh\`, which CI runs without \`UPDATE\`: each file through its stage with 1 GB of address space and 5 s of processor time. The small ones lie in \`fixtures/hostile/\`, the others the script makes. What is refused, and by which limit, is in [limits.md](limits.md)."
        echo
        echo "| command | exit | peak MB | CPU s |"
        echo "|---|---|---|---|"
        cat "$scratch/table"
    } > ../../docs/hostile.md
fi
echo "nothing in fixtures/hostile takes more than 1 GB or 5 s; all is said"
