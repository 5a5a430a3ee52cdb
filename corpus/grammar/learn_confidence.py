#!/usr/bin/env python3
"""Learns corpus/grammar/confidence.tsv: how much each doubt of a reading lowers the chance that all of it is right.

    python3 corpus/grammar/learn_confidence.py LABELLED.jsonl...

Run from the repository's root after `cargo build --release`; then build once more. Each line of the files has `id`,
`text` and the slots of docs/annotation.md: `object`, `also`, `room`, `target`, `pairs`, `destination`, `not`, `then`.
Logistic regression with a ridge, by Newton's method; needs nothing but Python 3. Each writer's lots (the number that
their names begin with) are left out once, and the calibration error and the area under the curve are told for those.
"""
import json
import math
import os
import subprocess
import sys
from collections import Counter

OUT = "corpus/grammar/confidence.tsv"
RIDGE = 1.0
# What never makes a reading surer: words left out, nouns nobody knows, repairs.
CHARGES = ("lost_", "unknown_", "inferred_", "mended", "correction", "ruled_out", "not_unused", "cost", "doubtful_")
LEAST_CHARGE = -0.05
# A strange word also makes the text longer, and what is counted by the word less: it costs more than that can gain.
LEAST = {"unknown_word": -0.25, "mended": -0.25}
SAME = {"sofa": "couch", "key": "keys", "phone": "cellphone", "cell_phone": "cellphone", "glass_case": "glasses_case"}


def same(word):
    return SAME.get(word, word)


def head(word):
    word = (same(word) or "").split("_")[-1]
    return word[:-1] if word.endswith("s") and not word.endswith(("ss", "glasses", "keys", "stairs")) else word


def kind(word):
    if not word:
        return None
    table = word.endswith("table") or word in ("desk", "nightstand", "counter", "stand")
    return "table" if table else head(word)


def slots(g, gold):
    """The slots of an errand, in a form that can be compared."""
    if gold:
        pairs, target, thing, room = g["pairs"], g["target"], g["object"], g["room"]
    else:
        nodes = g.get("nodes") or []
        pairs = [(p["reference"], p["direction"]) for n in nodes for p in n.get("pairs", [])]
        targets = [n["target"] for n in nodes if n.get("target")]
        target, thing, room = (targets or [None])[-1], (g.get("object") or {}).get("name"), g.get("room") or {}
    names = lambda things: sorted(head(t["name"] if isinstance(t, dict) else t) for t in things or [])
    goal = g.get("destination") or {}
    return (
        head(thing) if thing else None,
        names(g.get("also")),
        (same(room.get("name")), room.get("side")),
        kind(target),
        Counter((head(a), b) for a, b in pairs if (a, b) != ("move", "front")),
        tuple(head(goal[k]) if goal.get(k) else None for k in ("recipient", "room", "target")),
        names(g.get("not")),
        [slots(t, gold) for t in g.get("then") or []],
    )


def read(files):
    rows = [json.loads(line) for name in files for line in open(name) if line.strip()]
    data = "".join(json.dumps({"id": r["id"], "text": r["text"]}) + "\n" for r in rows).encode()
    for program in ("chunk", "ground"):
        run = subprocess.run([f"target/release/{program}"], input=data, capture_output=True)
        if run.returncode not in (0, 3):
            sys.exit(run.stderr.decode())
        data = run.stdout
    told = [json.loads(line)["grounding"] for line in data.decode().splitlines()]
    return [(g.get("doubts", {}), float(slots(r, True) == slots(g, False))) for r, g in zip(rows, told)]


def solve(a, b):
    n = len(b)
    m = [row[:] + [b[i]] for i, row in enumerate(a)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(m[r][i]))
        m[i], m[pivot] = m[pivot], m[i]
        for r in range(i + 1, n):
            f = m[r][i] / m[i][i]
            if f:
                for c in range(i, n + 1):
                    m[r][c] -= f * m[i][c]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (m[i][n] - sum(m[i][c] * x[c] for c in range(i + 1, n))) / m[i][i]
    return x


def fit(rows, names):
    features = [[1.0] + [d.get(name, 0.0) for name in names] for d, _ in rows]
    right = [r for _, r in rows]
    n = len(names) + 1
    w = [0.0] * n
    for _ in range(25):
        p = [1 / (1 + math.exp(-max(-30, min(30, sum(a * b for a, b in zip(w, x)))))) for x in features]
        gradient = [sum((right[i] - p[i]) * x[j] for i, x in enumerate(features)) - RIDGE * (j > 0) * w[j] for j in range(n)]
        hessian = [[0.0] * n for _ in range(n)]
        for i, x in enumerate(features):
            weight = p[i] * (1 - p[i])
            active = [j for j in range(n) if x[j]]
            for j in active:
                for k in active:
                    hessian[j][k] += weight * x[j] * x[k]
        for j in range(n):
            hessian[j][j] += RIDGE if j else 1e-9
        step = solve(hessian, gradient)
        w = [a + b for a, b in zip(w, step)]
        if max(map(abs, step)) < 1e-6:
            break
    return w


def fit_with_charges(rows, names):
    """The weights by name; a charge that would come out a credit costs the least there is, and the others are fitted to that."""
    fixed = {}
    while True:
        free = [name for name in names if name not in fixed]
        weights = dict(zip(["constant"] + free, fit(rows, free)))
        credit = [name for name in free if name.startswith(CHARGES) and weights[name] > LEAST.get(name, LEAST_CHARGE)]
        if not credit:
            return {**weights, **fixed}
        fixed.update({name: LEAST.get(name, LEAST_CHARGE) for name in credit})


def quality(rows, w):
    sure = []
    for d, right in rows:
        z = w["constant"] + sum(w.get(name, 0.0) * count for name, count in d.items())
        sure.append((1 / (1 + math.exp(-z)), right))
    bins = [[] for _ in range(10)]
    for score, right in sure:
        bins[min(9, int(score * 10))].append((score, right))
    error = sum(abs(sum(s for s, _ in b) - sum(r for _, r in b)) for b in bins) / max(1, len(sure))
    good, bad = [s for s, r in sure if r], [s for s, r in sure if not r]
    wins = sum((a > b) + 0.5 * (a == b) for a in good for b in bad)
    return error, wins / max(1, len(good) * len(bad))


def main():
    lots = {name: read([name]) for name in sys.argv[1:]}
    rows = [row for lot in lots.values() for row in lot]
    if not rows:
        sys.exit(__doc__)
    names = sorted({name for d, _ in rows for name in d})
    writer = lambda lot: os.path.basename(lot).split("-")[0]
    for one in sorted(set(map(writer, lots))):
        apart = [row for name, lot in lots.items() if writer(name) == one for row in lot]
        rest = [row for name, lot in lots.items() if writer(name) != one for row in lot]
        if rest:
            error, auc = quality(apart, fit_with_charges(rest, names))
            print(f"without {one}, on its {len(apart)} lines: calibration error {error:.3f}, area under the curve {auc:.3f}")
    weights = fit_with_charges(rows, names)
    with open(OUT, "w") as out:
        out.write("# What each doubt is worth to the confidence of a reading (logistic regression); learn_confidence.py learns them.\n")
        for name in ["constant"] + names:
            out.write(f"{name}\t{weights[name]:.3f}\n")


if __name__ == "__main__":
    main()
