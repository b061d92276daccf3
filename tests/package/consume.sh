#!/usr/bin/env bash
# consume.sh PREFIX METHOD KINEMATICS(ON|OFF) FOLDER [cmake arguments]: builds the consumer against an installed dmp
# (or, with add_subdirectory, against the sources) in FOLDER and runs its programs.
set -euo pipefail
prefix=$1 method=$2 kinematics=$3 folder=$4
shift 4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
prefix=$(realpath -m "$prefix")
pkgconfig=$prefix/lib/pkgconfig
[ -d "$pkgconfig" ] || pkgconfig=$prefix/lib/$(c++ -print-multiarch)/pkgconfig
libraries=$(dirname "$pkgconfig")
export PKG_CONFIG_PATH=$pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
export LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
cmake -S "$here" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
  -DMETHOD="$method" -DKINEMATICS="$kinematics" "$@" >"$folder.log" 2>&1 || { cat "$folder.log" >&2; exit 1; }
cmake --build "$folder" >"$folder.log" 2>&1 || { cat "$folder.log" >&2; exit 1; }
ctest --test-dir "$folder" --output-on-failure >"$folder.log" 2>&1 || { cat "$folder.log" >&2; exit 1; }
