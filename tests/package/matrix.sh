#!/usr/bin/env bash
# Every way to use the library: {shared, static} x {core, core + kinematics} x {find_package, pkg-config,
# add_subdirectory}. Core is built with KDL and urdfdom out of sight.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
scratch=$root/build/package  # kept: the next run builds only what changed
rm -rf "$scratch"/prefix-*
for shared in ON OFF; do
  for kinematics in OFF ON; do
    name=shared-$shared-kinematics-$kinematics
    hidden=()
    [ $kinematics = ON ] || hidden=(-DCMAKE_DISABLE_FIND_PACKAGE_orocos_kdl=ON -DCMAKE_DISABLE_FIND_PACKAGE_urdfdom=ON)
    mkdir -p "$scratch"
    cmake -S "$root" -B "$scratch/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DDMP_TESTS=OFF -DBUILD_SHARED_LIBS=$shared \
      -DDMP_KINEMATICS=$kinematics "${hidden[@]}" >/dev/null
    cmake --build "$scratch/$name" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
    cmake --install "$scratch/$name" --prefix "$scratch/prefix-$name" >/dev/null
    for method in find_package pkg_config add_subdirectory; do
      "$here/consume.sh" "$scratch/prefix-$name" $method $kinematics "$scratch/$name-$method" \
        -DBUILD_SHARED_LIBS=$shared "${hidden[@]}"
      echo "ok  shared=$shared kinematics=$kinematics $method"
    done
  done
done
