#!/usr/bin/env python3
"""The recipe of docs/scaling.md with PySpark: the bytes of one process, and a failure that is not swallowed.

Needs pyspark and Java; the executables have to be on the PATH. Usage: spark_check.py < texts.jsonl
"""
import os
import subprocess
import sys

from pyspark import SparkContext

STAGES = "set -o pipefail; chunk -j 1 | ground -j 1 --brief | plan -j 1 | drive -j 1"
COMMAND = f"bash -c '{STAGES}'"
# pipe() hands on no environment of its own.
ENVIRONMENT = {"PATH": os.environ["PATH"]}


def main():
    texts = sys.stdin.read().splitlines()
    one = subprocess.run(["bash", "-c", STAGES], input="\n".join(texts) + "\n", capture_output=True, text=True, check=True)
    context = SparkContext(master="local[2]", appName="spatial-fetch")
    context.setLogLevel("OFF")
    try:
        check(context, texts, one.stdout.splitlines())
    finally:
        # Before the folders go in which it works.
        context.stop()


def check(context, texts, one):
    many = context.parallelize(texts, 5).pipe(COMMAND, ENVIRONMENT, checkCode=True).collect()
    assert many == one, "Spark's records differ from those of one process"
    try:
        context.parallelize(texts + ['{"id":"bad","text":7}'], 5).pipe(COMMAND, ENVIRONMENT, checkCode=True).collect()
    except Exception:
        print(f"PySpark: {len(many)} records, the same bytes as one process; a failure is passed on")
    else:
        sys.exit("a failed task went unnoticed")


if __name__ == "__main__":
    main()
