#!/usr/bin/env bash
# A Debian package of the release build: executables, manual pages, completion scripts, documents. Needs cargo-deb,
# and cargo-about for the licence texts of the crates that are linked in.
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
# What may be linked in, with every licence's text and whose it is; about.toml says which licences those may be.
cargo about generate --fail --output-file "$release/licences.html" about.hbs
cargo deb --no-build "$@"
