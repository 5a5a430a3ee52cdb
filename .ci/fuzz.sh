#!/usr/bin/env bash
# Fuzzes each parser for some seconds (default 300), or those named: .ci/fuzz.sh 600 packets sip
# Needs a nightly toolchain and cargo-fuzz. Our code holds no `unsafe`, so the address sanitizer is left out: without it
# twice as many inputs are tried. What is found on the way stays in fuzz/corpus, what fails in fuzz/artifacts.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-300}
shift || true
targets=("$@")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(cargo +nightly fuzz list)

for target in "${targets[@]}"; do
    printf '\n== %s\n' "$target"
    mkdir -p "fuzz/corpus/$target"
    cargo +nightly fuzz run -s none "$target" "fuzz/corpus/$target" "fuzz/seeds/$target" -- \
        -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=20 -max_len=8192 -print_final_stats=1
done
