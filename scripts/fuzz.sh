#!/usr/bin/env bash
# Runs every fuzzer on its seeds. Usage: scripts/fuzz.sh [SECONDS a target, 10] [model|urdf|readers ...]
# A crash, an input that takes more than a second or more than 512 MB ends it with an error and keeps the input.
# PYTHON (default .venv/bin/python) must have dmpcpp; the readers need atheris, the others clang-22.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
seconds=${1:-10}
shift || true
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(model urdf readers)
python=${PYTHON:-$root/.venv/bin/python}
found=$root/build/fuzz/found
mkdir -p "$found"
TIMEFORMAT=%0U

build() {
  [ -n "${built:-}" ] && return
  cmake --preset fuzz >/dev/null
  cmake --build build/fuzz --target fuzz_model fuzz_urdf >build/fuzz/log 2>&1 || { cat build/fuzz/log >&2; exit 1; }
  built=yes
}

run() {
  local target=$1 log=build/fuzz/$1.log
  shift
  mkdir -p "build/fuzz/corpus/$target"
  { time "$@" -max_total_time="$seconds" -artifact_prefix="$found/$target-" -print_final_stats=1 >"$log" 2>&1; } 2>"$log.cpu" ||
    { tail -n 60 "$log" >&2; echo "fuzz $target: failed, input kept in $found" >&2; exit 1; }
  echo "ok  fuzz $target: $(sed -n 's/^Done \([0-9]*\) runs in \([0-9]*\).*/\1 runs in \2 s/p' "$log"), $(cat "$log.cpu") s of a processor"
}

export LSAN_OPTIONS=suppressions=$root/tests/sanitizers/leaks.txt:print_suppressions=0
for target in "${targets[@]}"; do
  if [ "$target" = readers ]; then
    "$python" -c 'import atheris' 2>/dev/null || { echo "skipped  fuzz readers: no atheris"; continue; }
    mkdir -p build/fuzz/seeds/readers
    "$python" tests/fuzz/fuzz_readers.py --seeds build/fuzz/seeds/readers >build/fuzz/log 2>&1 || { cat build/fuzz/log >&2; exit 1; }
    run readers "$python" tests/fuzz/fuzz_readers.py build/fuzz/corpus/readers build/fuzz/seeds/readers -timeout=5 -rss_limit_mb=512
  else
    command -v clang++-22 >/dev/null || { echo "skipped  fuzz $target: no clang-22"; continue; }
    build
    run "$target" "build/fuzz/tests/fuzz/fuzz_$target" "build/fuzz/corpus/$target" "tests/fuzz/seeds/$target" \
      -dict="tests/fuzz/$target.dict" -timeout=1 -rss_limit_mb=512 -max_len=65536
  fi
done
