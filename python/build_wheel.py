#!/usr/bin/env python3
"""Makes a wheel of the executables and the module: python/build_wheel.py [FOLDER]

    cargo build --release && python3 python/build_wheel.py dist && pip install dist/*.whl

A wheel is a zip file with a list of what it holds, so nothing but Python's own library is needed. It is for the system
it is made on: the executables link that system's C library."""

import base64
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

HOME = pathlib.Path(__file__).resolve().parent
STAGES = ("chunk", "ground", "plan", "drive", "hof", "perceive", "evaluate")


def version():
    manifest = (HOME.parent / "Cargo.toml").read_text()
    return re.search(r'^version = "(.+)"$', manifest, re.MULTILINE).group(1)


def built():
    """The folder of the release executables."""
    told = subprocess.run(
        ["cargo", "metadata", "--format-version", "1", "--no-deps"], cwd=HOME.parent, capture_output=True, check=True
    )
    return pathlib.Path(json.loads(told.stdout)["target_directory"]) / "release"


def contents(name):
    """Every file of the wheel: its name, its bytes, and whether it is to be run."""
    for path in sorted((HOME / "spatial_fetch").glob("*")):
        if path.is_file():
            yield f"spatial_fetch/{path.name}", path.read_bytes(), False
    for stage in STAGES:
        path = built() / stage
        if not path.exists():
            sys.exit(f"{path} is not there: run cargo build --release first")
        yield f"{name}.data/scripts/{stage}", path.read_bytes(), True
    for licence in ("LICENSE-MIT", "LICENSE-APACHE"):
        yield f"{name}.dist-info/licenses/{licence}", (HOME.parent / licence).read_bytes(), False
    metadata = (
        f"Metadata-Version: 2.4\nName: spatial-fetch\nVersion: {version()}\n"
        "Summary: Tell a robot in ordinary words where something is, and send it there.\n"
        "License-Expression: MIT OR Apache-2.0\nRequires-Python: >=3.9\nProvides-Extra: table\n"
        "Requires-Dist: pandas; extra == 'table'\n"
    )
    yield f"{name}.dist-info/METADATA", metadata.encode(), False
    yield f"{name}.dist-info/WHEEL", f"Wheel-Version: 1.0\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode(), False


def tag():
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"py3-none-{platform}"


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "dist")
    folder.mkdir(parents=True, exist_ok=True)
    name = f"spatial_fetch-{version()}"
    wheel = folder / f"{name}-{tag()}.whl"
    lines = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as packed:
        for inside, data, runs in contents(name):
            entry = zipfile.ZipInfo(inside)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if runs else 0o100644) << 16
            packed.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            lines.append(f"{inside},sha256={digest},{len(data)}\n")
        lines.append(f"{name}.dist-info/RECORD,,\n")
        packed.writestr(f"{name}.dist-info/RECORD", "".join(lines))
    print(wheel)


if __name__ == "__main__":
    main()
