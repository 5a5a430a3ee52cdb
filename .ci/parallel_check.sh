#!/usr/bin/env bash
# The recipe of docs/scaling.md with GNU parallel: the bytes of one process, and a failure that is not swallowed.
set -euo pipefail
cd "$(dirname "$0")/.."
export PARALLEL_SHELL=/bin/bash
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

jq -c '{id, text}' corpus/templates.jsonl > "$folder/texts.jsonl"
# shellcheck disable=SC2016
stages='set -o pipefail; chunk -j 1 | ground -j 1 --brief | plan -j 1 | drive -j 1'
in_parallel() { parallel --will-cite --pipepart --keep-order --halt soon,fail=1 --block -4 -j 2 -a "$1" "$stages"; }

in_parallel "$folder/texts.jsonl" > "$folder/many.jsonl"
bash -c "$stages" < "$folder/texts.jsonl" > "$folder/one.jsonl"
cmp "$folder/one.jsonl" "$folder/many.jsonl"

# Parts scored where they lie add up to the whole.
split -n l/3 "$folder/many.jsonl" "$folder/part-"
for part in "$folder"/part-??; do evaluate score --part --gold corpus/templates.jsonl "$part" > "$part.score.json"; done
evaluate merge --gold corpus/templates.jsonl "$folder"/part-*.score.json | jq -S 'del(.. | .spl_sum?)' > "$folder/merged.json"
evaluate score --gold corpus/templates.jsonl "$folder/one.jsonl" | jq -S 'del(.. | .spl_sum?)' > "$folder/whole.json"
cmp "$folder/merged.json" "$folder/whole.json"

# A record that fails in one job fails the run.
{ cat "$folder/texts.jsonl"; echo '{"id":"bad","text":7}'; } > "$folder/bad.jsonl"
if in_parallel "$folder/bad.jsonl" > /dev/null 2> "$folder/said"; then
    echo "a failed job went unnoticed" >&2
    exit 1
fi
grep -q '(record "bad")' "$folder/said"
echo "GNU parallel: the same bytes as one process; a failure is passed on"
