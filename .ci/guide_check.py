#!/usr/bin/env python3
"""Runs every command of a document and compares what it prints with what the document shows.

Usage: guide_check.py DOCUMENT...        UPDATE=1 writes what is printed into the documents.
In blocks marked `console` each line that begins with `$ ` is a command, further lines that begin with `> ` go on
with it, and the rest is what it prints on both streams. All commands of one document run in one empty folder in
which corpus/ and fixtures/ are the repository's. The executables have to be on the PATH.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"```console\n(.*?)```", re.S)


def run(command, folder):
    ran = subprocess.run(["bash", "-c", command], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, timeout=300, env={**os.environ, "NO_COLOR": "1"})
    return ran.stdout.decode().rstrip("\n")


def commands_of(block):
    """Pairs of a command's lines and the lines it is shown to print."""
    parts = []
    for line in block.rstrip("\n").split("\n"):
        if line.startswith("$ "):
            parts.append(([line], []))
        elif line.startswith("> ") and parts and not parts[-1][1]:
            parts[-1][0].append(line)
        elif parts:
            parts[-1][1].append(line)
    return parts


def check(document):
    text = document.read_text()
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name in ("corpus", "fixtures", "docs"):
            os.symlink(ROOT / name, pathlib.Path(folder, name))

        def renew(match):
            lines = []
            for command, shown in commands_of(match.group(1)):
                printed = run("\n".join(line[2:] for line in command), folder)
                if printed.rstrip() != "\n".join(shown).rstrip():
                    wrong.append(f"{document}: {command[0]}\n--- shown\n" + "\n".join(shown) + f"\n--- printed\n{printed}\n")
                lines += command + ([printed] if printed else [])
            return "```console\n" + "\n".join(lines) + "\n```"

        renewed = BLOCK.sub(renew, text)
    if os.environ.get("UPDATE"):
        document.write_text(renewed)
        return []
    print(f"{document}: {len(BLOCK.findall(text))} blocks run")
    return wrong


if __name__ == "__main__":
    failures = [failure for name in sys.argv[1:] for failure in check(pathlib.Path(name))]
    sys.exit("\n".join(failures) + "\nUPDATE=1 .ci/guide_check.py writes what is printed" if failures else 0)
