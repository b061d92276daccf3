#!/usr/bin/env bash
# What a wheel is built from in a manylinux image (AlmaLinux), where KDL and urdfdom are not packaged. Licences go to
# LICENCES as LIBRARY.txt, where repair_wheel.sh finds them.
set -euo pipefail
LICENCES=${LICENCES:-/usr/share/licenses/dmpcpp}

# The licence files of a source folder, for every shared library of an install manifest.
keep_licence() {
  local source=$1 manifest=$2 library texts
  texts=$(find "$source" -maxdepth 1 -type f \( -name 'LICENSE*' -o -name 'COPYING*' \))
  for library in $({ grep '\.so' "$manifest" || true; } | xargs -r -n 1 basename); do
    [ -n "$texts" ] || { echo "manylinux: no LICENSE or COPYING in $source for $library" >&2; exit 1; }
    # shellcheck disable=SC2086
    cat $texts >"$LICENCES/$library.txt"
  done
}

# TinyXML comes as a package; its licence is the first comment of its header.
keep_licence_of_tinyxml() {
  local library
  for library in "$1"/libtinyxml.so*; do
    sed '/\*\//q' "$2" >"$LICENCES/$(basename "$library").txt"
  done
}

build() {
  local source=source/${3:-.}
  git clone --depth 1 --branch "$2" "$1" source
  cmake -S "$source" -B built -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_TESTING=OFF -DENABLE_TESTS=OFF
  cmake --build built && cmake --install built
  keep_licence "$source" built/install_manifest.txt
  rm -rf source built
}

dnf install -y eigen3-devel tinyxml2-devel tinyxml-devel git cmake ninja-build
mkdir -p "$LICENCES"
keep_licence_of_tinyxml /usr/lib64 /usr/include/tinyxml.h
cd "$(mktemp -d)"
build https://github.com/nlohmann/json v3.11.2
build https://github.com/ros/console_bridge 1.0.2
build https://github.com/ros/urdfdom_headers 1.0.5
build https://github.com/ros/urdfdom 3.0.1
build https://github.com/orocos/orocos_kinematics_dynamics v1.5.1 orocos_kdl
ldconfig
