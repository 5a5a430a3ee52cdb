#!/usr/bin/env bash
# A Debian package of the release build: executables, manual pages, completion scripts, documents. Needs cargo-deb.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --bins --quiet
release="$(cargo metadata --format-version 1 --no-deps | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')/release"
mkdir -p "$release"/completions/{bash,zsh,fish}
for name in chunk ground plan drive hof perceive evaluate; do
    "$release/$name" --completions bash > "$release/completions/bash/$name"
    "$release/$name" --completions zsh > "$release/completions/zsh/_$name"
    "$release/$name" --completions fish > "$release/completions/fish/$name.fish"
done
cargo deb --no-build "$@"
