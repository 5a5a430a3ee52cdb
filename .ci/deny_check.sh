#!/usr/bin/env bash
# Licences, sources, doubles and advisories of the dependencies by deny.toml. cargo-deny is compiled where it is
# missing: with a time limit, since everything else has been checked by then. Advisories come from the RustSec
# database; when that cannot be reached, the copy of an earlier run is taken, and without one the check is said to be
# missing. It never passes silently.
set -euo pipefail
cd "$(dirname "$0")/.."
if ! cargo deny --version > /dev/null 2>&1; then
    if ! timeout 300 cargo install --quiet --locked cargo-deny; then
        echo "NOT CHECKED: licences and advisories (cargo-deny did not install within five minutes)"
        exit 0
    fi
fi
cargo deny --all-features check licenses sources bans
database="${CARGO_HOME:-$HOME/.cargo}/advisory-dbs"
if timeout 120 cargo deny --all-features fetch db; then
    cargo deny --all-features check advisories
elif copy=$(compgen -G "$database/*/crates" | head -1) && [ -n "$copy" ]; then
    # A clone that failed leaves an empty folder: only one with advisories in it is a copy.
    echo "the advisory database cannot be reached: checking by the copy of $(date -r "$copy" +%F)"
    cargo deny --all-features --offline check advisories
else
    echo "NOT CHECKED: advisories (the database cannot be reached, and there is no copy of it)"
fi
