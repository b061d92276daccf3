#!/usr/bin/env bash
# Makes the Debian packages, installs them, rebuilds the consumer and the examples against them, and removes them again.
# Needs root (apt).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
[ "$(id -u)" -eq 0 ] || { echo "debian.sh: needs root to install packages" >&2; exit 2; }
if dpkg-query -W libdmp-dev >/dev/null 2>&1; then
  echo "debian.sh: libdmp-dev is installed already; remove it first" >&2
  exit 2
fi
scratch=$(mktemp -d)
finish() {
  apt-get purge -y -q libdmp-dev libdmp-kinematics-dev >/dev/null 2>&1 || true
  rm -rf "$scratch"
}
trap finish EXIT
cmake -S "$root" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DDMP_TESTS=OFF >/dev/null
cmake --build "$scratch/build" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
(cd "$scratch/build" && cpack -G DEB -B "$scratch/deb" >"$scratch/log" 2>&1) || { cat "$scratch/log" >&2; exit 1; }
for package in "$scratch"/deb/*.deb; do
  echo "$(basename "$package"): $(dpkg-deb -f "$package" Depends)"
done
apt-get install -y -q --no-install-recommends "$scratch"/deb/*.deb >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
for method in find_package pkg_config; do
  "$here/consume.sh" /usr $method ON "$scratch/$method" -DEXAMPLES=ON
  echo "ok  $method against the installed packages, examples included"
done
