#!/usr/bin/env bash
# The wheel in a fresh environment: built, installed, used, the notebook run, and ten thousand sentences from a table to
# a table. Needs python3 and the release executables.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
python3 python/build_wheel.py "$scratch/dist"
python3 -m venv "$scratch/venv"
"$scratch/venv/bin/pip" install --quiet "$scratch"/dist/*.whl pandas nbclient nbformat ipykernel
notebook=$PWD/examples/first_afternoon.ipynb
cd "$scratch" # away from the sources: what is imported is what was installed
"$scratch/venv/bin/python" - "$notebook" << 'PYTHON'
import sys

import nbclient
import nbformat
import spatial_fetch

notebook = nbformat.read(sys.argv[1], as_version=4)
nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
shown = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
assert any("trial.spl" in str(output) for output in shown), "the notebook shows its table"

trials = spatial_fetch.fetch([{"id": "x", "mine": [1, 2], "text": "the mug is on the table in the bedroom"}], seed=3)
assert trials[0]["mine"] == [1, 2] and trials[0]["trial"]["outcome"] == "found", trials
home = spatial_fetch.fetch(["find the book"], world="studio")
assert home[0]["trial"]["outcome"] == "found", home
try:
    spatial_fetch.run("ground", ["nothing was chunked"])
except spatial_fetch.StageError as error:
    assert error.stage == "ground" and error.code == 1 and "`chunk`" in str(error), error
else:
    raise AssertionError("an error is an exception")
three = spatial_fetch.understand(["go left", {"text": 7}, "go right"], keep_going=True)
assert ["grounding" in record for record in three] == [True, False, True], three

with open("many.csv", "w") as table:
    table.write("who,said\n" + 'anna,"the mug is on the table, next to the bed"\n' * 10_000)
PYTHON
"$scratch/venv/bin/chunk" --csv said many.csv | "$scratch/venv/bin/ground" | "$scratch/venv/bin/plan" |
    "$scratch/venv/bin/drive" --dry-run --format csv > rows.csv
[ "$(wc -l < rows.csv)" = 10001 ] || { echo "ten thousand rows became $(wc -l < rows.csv)" >&2; exit 1; }
head -2 rows.csv | grep -q anna || { echo "the other columns are gone" >&2; exit 1; }
echo "the wheel: installed, the notebook run, ten thousand rows from a table to a table"
