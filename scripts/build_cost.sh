#!/usr/bin/env bash
# What an edit costs: how long the compiler works after FILE was touched, in a build tree that is up to date.
#   scripts/build_cost.sh [BUILD [FILE ...]]     (build/release; options.hpp, a test, a .py file)
# Two figures: the sum of the steps by ninja's log (s, grows where others use the machine) and processor time (s).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build/release}
shift || true
files=("$@")
[ ${#files[@]} -gt 0 ] || files=(cpp/include/dmp/options.hpp tests/cpp/test_refusals.cpp python/dmpcpp/arms.py)
export CCACHE_DISABLE=1
TIMEFORMAT='%U %S'

cmake --build "$build" >/dev/null
for file in "${files[@]}"; do
  started=$(date +%s%N)
  touch "$file"
  processor=$({ time cmake --build "$build" >/dev/null; } 2>&1 | awk '{print $1 + $2}')
  awk -F "\t" -v started="$started" -v file="$file" -v processor="$processor" '
    $3 + 0 > started + 0 {steps++; sum += ($2 - $1) / 1000}
    END {printf "%-32s %3d steps %7.1f s by the log %7.1f s of a processor\n", file, steps, sum, processor}'
done
