#!/usr/bin/env bash
# Instructions of one step and one fit, counted by callgrind and held against their record to 2 %:
#   scripts/instructions.sh            says how each stands; status 1 if one is more than 2 % off
#   scripts/instructions.sh --record   writes the record anew
# The record belongs to the compiler and C library that it names; others differ by more.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
record=benchmarks/cpp/instructions.txt
program=${PROGRAM:-build/release/benchmarks/cpp/operations}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

collected() {  # NAME REPEATS: instructions of the whole program
  valgrind --tool=callgrind --callgrind-out-file="$scratch/out" "$program" "$1" "$2" >/dev/null 2>"$scratch/log"
  awk '/Collected/ {print $NF}' "$scratch/log"
}
each() {  # NAME REPEATS: instructions of one, by the difference of two runs
  echo $((($(collected "$1" $((2 * $2))) - $(collected "$1" "$2")) / $2))
}
toolchain() { echo "$(g++ -dumpfullversion) glibc $(ldd --version | awk 'NR == 1 {print $NF}') $(uname -m)"; }

if [ "${1:-}" = --record ]; then
  {
    echo "# $(toolchain)"
    for name in step_position step_pose step_pose_log_linear; do echo "$name 1000 $(each "$name" 1000)"; done
    for name in fit_position fit_pose; do echo "$name 5 $(each "$name" 5)"; done
  } >"$scratch/record"
  mv "$scratch/record" "$record"
  cat "$record"
  exit
fi
if [ "# $(toolchain)" != "$(head -1 "$record")" ]; then
  echo "the record belongs to $(head -1 "$record" | cut -c 3-), here is $(toolchain): nothing to compare"
  exit
fi
failed=0
while read -r name repeats expected; do
  found=$(each "$name" "$repeats")
  percent=$(awk -v f="$found" -v e="$expected" 'BEGIN {printf "%+.2f", 100 * (f - e) / e}')
  if awk -v p="$percent" 'BEGIN {exit !(p > 2 || p < -2)}'; then verdict=OFF failed=1; else verdict=ok; fi
  printf '%-4s %-22s %9d instructions, recorded %9d (%s %%)\n' "$verdict" "$name" "$found" "$expected" "$percent"
done < <(tail -n +2 "$record")
exit $failed
