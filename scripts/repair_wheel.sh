#!/usr/bin/env bash
# Makes a built wheel self-contained: its libraries come into it by auditwheel, each with its licence, and what it holds
# is checked. Usage: scripts/repair_wheel.sh WHEEL FOLDER     (the result lies in FOLDER). Needs auditwheel and patchelf,
# and a python with the package `wheel`. Licences are Debian's, or lie in LICENCES as LIBRARY.txt (manylinux.sh).
set -euo pipefail
wheel=$1 folder=$2
LICENCES=${LICENCES:-/usr/share/licenses/dmpcpp}
bundled_most=6 size_most=$((2 * 1024 * 1024))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "repair_wheel: $*" >&2; exit 1; }

# The licence of a library, by its file name, into a folder.
add_licence() {
  local library=$1 licences=$2 package
  if [ -e "$LICENCES/$library.txt" ]; then
    cp "$LICENCES/$library.txt" "$licences/"
    return
  fi
  package=$(dpkg-query -S "*/$library" 2>/dev/null | head -n 1 | cut -d: -f1) || true
  [ -n "$package" ] || fail "$library: no licence text in $LICENCES and no Debian package known"
  cp "/usr/share/doc/$package/copyright" "$licences/$package.txt"
  # Debian's file names the LGPL of KDL and leaves its text out.
  cp /usr/share/common-licenses/LGPL-2.1 "$licences/LGPL-2.1.txt"
}

add_licences() {
  local unpacked=$1 licences library
  licences=$(echo "$unpacked"/*.dist-info)/licenses
  mkdir -p "$licences"
  for library in "$unpacked"/dmpcpp.libs/*.so*; do
    add_licence "$(basename "$library" | sed 's/-[0-9a-f]\{8\}\.so/.so/')" "$licences"
  done
  grep -rq 'GNU LESSER GENERAL PUBLIC LICENSE' "$licences" || fail "the text of the LGPL is missing"
}

check_contents() {
  local wheel=$1 listing size libraries
  size=$(stat -c %s "$wheel")
  listing=$(python -m zipfile -l "$wheel")
  libraries=$(grep -c 'dmpcpp\.libs/.*\.so' <<<"$listing")
  [ "$size" -le $size_most ] || fail "$wheel: $size bytes, expected at most $size_most"
  [ "$libraries" -le $bundled_most ] || fail "$wheel: $libraries bundled libraries, expected at most $bundled_most"
  for needed in 'dmpcpp/py\.typed' 'dmpcpp/_core/__init__\.pyi' 'licenses/LICENSE' 'licenses/liborocos-kdl.*\.txt'; do
    grep -q "$needed" <<<"$listing" || fail "$wheel: $needed is missing"
  done
  ! grep -Eq '\.hpp|\.cmake|\.a |\.cpp' <<<"$listing" || fail "$wheel: holds headers, sources or static libraries"
  echo "ok  $(basename "$wheel"): $size bytes, $libraries bundled libraries"
}

auditwheel repair -w "$work/repaired" "$wheel" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "auditwheel cannot repair $wheel"; }
python -m wheel unpack -d "$work/unpacked" "$work/repaired"/*.whl >/dev/null
add_licences "$work/unpacked"/*
mkdir -p "$work/packed" "$folder"
python -m wheel pack -d "$work/packed" "$work/unpacked"/* >/dev/null
check_contents "$work/packed"/*.whl
mv "$work/packed"/*.whl "$folder/"
