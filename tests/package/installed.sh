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
# A program that Eigen aligns in another way than the library must not link: it would read and free the wrong memory.
printf '#include <dmp/file.hpp>\nint main(int, char** argv) { return dmp::load_dmp(argv[1]).dimension() != 0; }\n' >"$scratch/other.cpp"
compile() {
  PKG_CONFIG_PATH=$(dirname "$(find "$scratch/prefix" -name dmp.pc)") sh -c \
    'g++ -std=c++17 "$@" $(pkg-config --cflags --libs dmp) -o "$0"' "$scratch/other" "$scratch/other.cpp" "$@"
}
compile 2>"$scratch/log" || { cat "$scratch/log" >&2; exit 1; }
if [ "$(uname -m)" = x86_64 ] && compile -mavx 2>"$scratch/log"; then
  echo "a program compiled with -mavx links to a libdmp that is not" >&2
  exit 1
fi
[ "$(uname -m)" != x86_64 ] || grep -q 'dmp_is_not_compiled_for_eigen_alignment_32' "$scratch/log"
library=$(find "$scratch/prefix" -name libdmp.so)
[ -n "$library" ] || exit 0
needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -Ev '^(libstdc\+\+|libm|libgcc_s|libc|ld-linux-[a-z0-9-]+)\.so' || true)
[ -z "$needed" ] || { echo "libdmp.so needs $needed, expected the C++ runtime alone" >&2; exit 1; }
