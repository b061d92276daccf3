#!/usr/bin/env bash
# Every proof of reliability, one row each: scripts/check.sh [NAME ...]; all of them unless named. docs/reliability.md
# says what each shows. SECONDS_FUZZ sets the time of a fuzzer (60). Logs lie in build/checks.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
logs=$root/build/checks
mkdir -p "$logs"
python=${PYTHON:-$root/.venv/bin/python}
all=(lint release package matrix debian asan tsan rtsan valgrind fuzz properties coverage mutation python-asan wheel)

set_up() { bash -c 'source scripts/setup.sh && set_up test'; }
# What the tests do not need: clang-22, valgrind, gcovr, atheris, tools of packages.
tools() { bash -c 'source scripts/setup.sh && set_up_checks'; }
preset() { cmake --preset "$1" && cmake --build --preset "$1" && ctest --preset "$1"; }

# In an environment of its own, so that it needs neither a compiler nor dmpcpp; clang-format as the commit hook has it.
check_lint() {
  local tools=build/lint/bin
  [ -x $tools/pip ] || python3 -m venv --clear build/lint || return 1
  $tools/pip install -q "$(grep -o 'ruff==[0-9.]*' pyproject.toml)" "$(grep -o 'clang-format==[0-9.]*' .pre-commit-config.yaml)" || return 1
  $tools/ruff check python tests benchmarks scripts && $tools/ruff format --check python tests benchmarks scripts &&
    find cpp python/bindings tests/cpp tests/fuzz examples benchmarks/cpp -name '*.[ch]pp' -print0 |
    xargs -0 $tools/clang-format --dry-run -Werror
}

# The movement primitives alone, what continuous integration has the time for: with the library of the fuzzers, whose
# clang compiles in a third of the time since ASan finds what its UBSan leaves out (null, object-size) at run time.
check_asan-core() {
  tools && cmake --preset fuzz && cmake --build build/fuzz --target core_tests &&
    DMP_CASES=500 ctest --test-dir build/fuzz --output-on-failure -j "$(nproc)" -L core
}

check_mutation() { "$python" scripts/mutation.py && "$python" scripts/mutation_python.py; }
check_release() { preset release; }
check_package() { cmake --preset release && cmake --build --preset release && tests/package/installed.sh build/release; }
check_matrix() { tests/package/matrix.sh; }
check_debian() { tools && tests/package/debian.sh; }
check_asan() { preset asan; }
check_tsan() { preset tsan; }
check_rtsan() { tools && preset rtsan; }
check_fuzz() { tools && PYTHON=$python scripts/fuzz.sh "${SECONDS_FUZZ:-60}"; }
check_properties() {  # 10^6 cases each; ctest takes 10^4
  cmake --preset release && cmake --build --preset release --target test_so3_properties test_dmp_properties &&
    DMP_CASES=1000000 build/release/tests/cpp/test_so3_properties && DMP_CASES=1000000 build/release/tests/cpp/test_dmp_properties
}
check_wheel() { tools && scripts/wheel.sh; }

check_valgrind() {
  tools && cmake --preset release && cmake --build --preset release --target example_01_fit example_03_pose example_05_inverse_kinematics &&
    (cd build/release/examples && for example in "01_fit" "03_pose" "05_inverse_kinematics $root/examples/arm.urdf"; do
      # shellcheck disable=SC2086
      valgrind -q --error-exitcode=9 --leak-check=full ./example_$example || exit 1
    done)
}

check_coverage() {
  mkdir -p build/coverage && find build/coverage -name '*.gcda' -delete && tools && preset coverage &&
    "$python" -m gcovr -r . build/coverage --filter cpp/src --exclude-throw-branches --exclude-unreachable-branches \
      --fail-under-line 95 --fail-under-branch 85 --print-summary
}

# The tests of what is written in C++, without processes and simulators of others.
of_the_core=({accuracy,align,arm,arms,dmp,inverse_kinematics,joint_tracker,learning,model_files,motion,motion_alignment,path_tracking}.py
  {refusals,so3,threads,time_optimal,urdf_changes}.py)
check_python-asan() {
  tools && cmake -S . -B build/python-asan -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DDMP_PYTHON=ON -DDMP_TESTS=OFF -DBUILD_SHARED_LIBS=OFF \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
    -DCMAKE_CXX_FLAGS="-fsanitize=address,undefined -fno-omit-frame-pointer" -DPYBIND11_FINDPYTHON=ON \
    -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)" -DPython_EXECUTABLE="$python" && cmake --build build/python-asan &&
    rm -rf build/python-asan/path && mkdir build/python-asan/path && cp -r python/dmpcpp build/python-asan/path/ &&
    cp build/python-asan/python/bindings/_core*.so build/python-asan/path/dmpcpp/ &&
    LD_PRELOAD="$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libstdc++.so)" ASAN_OPTIONS=detect_leaks=0 \
      UBSAN_OPTIONS=halt_on_error=1 PYTHONPATH=build/python-asan/path "$python" -m pytest -q "${of_the_core[@]/#/tests/python/test_}"
}

names=("$@")
[ ${#names[@]} -gt 0 ] || names=("${all[@]}")
for name in "${names[@]}"; do
  declare -F "check_$name" >/dev/null || { echo "check.sh: '$name' is unknown, expected one of ${all[*]}" >&2; exit 2; }
done
[ "${names[*]}" = lint ] || set_up
failed=0
for name in "${names[@]}"; do
  started=$SECONDS
  if "check_$name" >"$logs/$name.log" 2>&1; then verdict=ok; else verdict=FAILED failed=1; fi
  printf '%-12s %-7s %5d s  %s\n' "$name" "$verdict" $((SECONDS - started)) "$(tail -n 1 "$logs/$name.log" | cut -c 1-80)"
done
exit $failed
