# Sourced by demo.sh and test.sh: installs what is missing, and nothing when all is there.
# Debian packages through apt (as root or with sudo), then .venv with the package and its extras.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
venv="$root/.venv"

stop() {
  echo "dmpcpp: $*" >&2
  exit 1
}

debian_packages=(g++ cmake ninja-build libeigen3-dev liborocos-kdl-dev liburdfdom-dev nlohmann-json3-dev doctest-dev
  pkg-config python3.11 python3-venv python3-dev)
# Used by scripts/check.sh, not by the tests.
check_packages=(clang-22 libclang-rt-22-dev valgrind dpkg-dev fakeroot patchelf unzip)

missing_packages() {
  local package
  for package in "${debian_packages[@]}"; do
    dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii' || echo "$package"
  done
}

install_debian_packages() {
  local missing apt=(apt-get)
  command -v dpkg-query >/dev/null || stop "this is no Debian or Ubuntu: install ${debian_packages[*]} by hand."
  missing=$(missing_packages | tr '\n' ' ')
  [ -z "${missing// /}" ] && return
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || stop "needs root or sudo to install: $missing"
    apt=(sudo apt-get)
  fi
  echo "dmpcpp: installing $missing"
  export DEBIAN_FRONTEND=noninteractive
  "${apt[@]}" update -q >/dev/null || stop "apt-get update failed: is there a network?"
  # shellcheck disable=SC2086
  "${apt[@]}" install -y -q --no-install-recommends $missing >/dev/null || stop "apt-get could not install $missing"
}

# For scripts/check.sh: compilers with sanitizers and fuzzers, tools of packages.
install_packages_of_checks() {
  debian_packages=("${check_packages[@]}")
  install_debian_packages
  "$venv/bin/pip" install -q --disable-pip-version-check gcovr atheris pybind11
}

# Debian's own interpreter first: it has the headers and venv installed above.
find_python() {
  local candidate
  for candidate in /usr/bin/python3.11 python3.11; do
    "$candidate" -c 'import ensurepip, venv' 2>/dev/null && { echo "$candidate"; return; }
  done
  stop "needs python3.11 with venv (PyBullet has no wheels for newer ones): apt install python3.11 python3.11-venv"
}

# Everything that the installed package is made from.
sources_stamp() {
  (cd "$root" && { find cpp python cmake -type f ! -name '*.pyc' -print0; printf '%s\0' CMakeLists.txt pyproject.toml README.md scripts/setup.sh; } |
    sort -z | xargs -0 sha256sum | sha256sum)
}

install_python_package() {
  local stamp
  stamp="$(sources_stamp)"
  [ -x "$venv/bin/python" ] && [ "$(cat "$venv/dmpcpp.stamp" 2>/dev/null)" = "$stamp" ] && return
  if [ ! -x "$venv/bin/python" ]; then
    local python
    python=$(find_python) || exit 1
    "$python" -m venv "$venv" || stop "could not make $venv"
  fi
  echo "dmpcpp: building and installing the package into .venv (some minutes)"
  "$venv/bin/pip" install -q --disable-pip-version-check "$root[sim,mujoco,plot,formats,view,video,test]" ||
    stop "pip could not install the package: see above."
  echo "$stamp" >"$venv/dmpcpp.stamp"
}

install_debian_packages
install_python_package
