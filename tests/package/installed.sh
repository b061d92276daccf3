#!/usr/bin/env bash
# installed.sh BUILD: installs what was built into a scratch prefix, moves it, and builds a consumer against it by
# find_package and by pkg-config. libdmp itself may need nothing but the C++ runtime.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$1" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/prefix"
kinematics=OFF
[ -z "$(find "$scratch/prefix" -name 'dmp_kinematics.pc')" ] || kinematics=ON
for method in find_package pkg_config; do
  "$here/consume.sh" "$scratch/prefix" $method $kinematics "$scratch/$method"
done
library=$(find "$scratch/prefix" -name libdmp.so)
[ -n "$library" ] || exit 0
needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -Ev '^(libstdc\+\+|libm|libgcc_s|libc|ld-linux-[a-z0-9-]+)\.so' || true)
[ -z "$needed" ] || { echo "libdmp.so needs $needed, expected the C++ runtime alone" >&2; exit 1; }
