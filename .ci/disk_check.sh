#!/usr/bin/env bash
# A disk that fills up while records are written: it is said, and nothing half-written stays. Needs root, for a tiny tmpfs.
set -euo pipefail
cd "$(dirname "$0")/.."
disk=$(mktemp -d)
mount -t tmpfs -o size=64k tmpfs "$disk"
frames=$(mktemp -d)
complaint=$(mktemp)
trap 'umount "$disk"; rm -r "$disk" "$frames" "$complaint"' EXIT

said=$(seq 2000 | sed 's/.*/the mug is in the bedroom on the table by the chairs/')
chunked=$(chunk <<< "$said")
full() {
    local code=0
    "$@" 2> "$complaint" || code=$?
    if [ "$code" != 1 ] || ! grep -q 'the disk is full' "$complaint" || [ -n "$(ls -A "$disk")" ]; then
        echo "$*: exit $code, said: $(cat "$complaint"), left: $(ls -A "$disk")" >&2
        exit 1
    fi
}
full chunk -o "$disk/out.jsonl" <<< "$said"
full ground -o "$disk/out.jsonl" <<< "$chunked"
ground <<< "$chunked" | full plan -o "$disk/out.jsonl"
sed -n 1,60p <<< "$chunked" | ground | plan | full drive -o "$disk/out.jsonl"
shapes='{"a":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]},"b":{"type":"Polygon","coordinates":[[[3,0],[4,0],[4,1],[3,0]]]}}'
for _ in $(seq 100); do echo "$shapes"; done | full hof -o "$disk/out.jsonl"
evaluate frames --count 40 --seed 3 --quiet --into "$frames"
full perceive "$frames/index.jsonl" -o "$disk/out.jsonl"
echo "a full disk is said, and nothing half-written stays"
