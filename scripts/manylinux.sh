#!/usr/bin/env bash
# What a wheel is built from in a manylinux image (AlmaLinux), where KDL and urdfdom are not packaged.
set -euo pipefail
dnf install -y eigen3-devel tinyxml2-devel tinyxml-devel git cmake ninja-build
build() {
  git clone --depth 1 --branch "$2" "$1" source
  cmake -S "source/${3:-.}" -B built -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_TESTING=OFF -DENABLE_TESTS=OFF
  cmake --build built && cmake --install built
  rm -rf source built
}
cd "$(mktemp -d)"
build https://github.com/nlohmann/json v3.11.2
build https://github.com/ros/console_bridge 1.0.2
build https://github.com/ros/urdfdom_headers 1.0.5
build https://github.com/ros/urdfdom 3.0.1
build https://github.com/orocos/orocos_kinematics_dynamics v1.5.1 orocos_kdl
ldconfig
