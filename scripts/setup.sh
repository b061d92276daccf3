# Sourced by demo.sh and test.sh: `set_up demo` and `set_up test` install and build what is missing, and nothing else:
# packages of the system (apt, as root or with sudo), .venv with the Python packages, build/release with the C++.
# --without-bullet leaves PyBullet out, --with EXTRA,.. adds extras of pyproject.toml. The whole output lies in build/setup.log.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
venv=$root/.venv
build=$root/build/release
log=$root/build/setup.log
cache=${XDG_CACHE_HOME:-${HOME:-$root/build}/.cache}/dmpcpp  # PyBullet, compiled once for all checkouts
mkdir -p "$cache" 2>/dev/null && [ -w "$cache" ] || cache=$root/build/cache  # a home that cannot be written

# Debian 12 and 13 and Ubuntu 24.04 call them the same.
packages_demo=(g++ cmake ninja-build libeigen3-dev liborocos-kdl-dev liburdfdom-dev nlohmann-json3-dev
  python3 python3-venv python3-dev)
packages_test=("${packages_demo[@]}" doctest-dev pkg-config)
packages_check=(clang-22 libclang-rt-22-dev valgrind dpkg-dev fakeroot patchelf unzip)
systems=" debian-12 debian-13 ubuntu-24.04 "

extras_demo=(plot view)
extras_test=("${extras_demo[@]}" mujoco formats video test)

stop() {
  echo "dmpcpp: $*" >&2
  exit 1
}

# step WHAT COMMAND...: one line on the screen with the time it took; its output goes to the log.
step() {
  local what=$1 started=$SECONDS
  shift
  printf '%-64s' "dmpcpp: $what"
  if ! "$@" >>"$log" 2>&1 </dev/null; then
    printf 'failed\n'
    tail -n 15 "$log" >&2
    stop "$what: failed. All of the output: $log"
  fi
  printf '%4d s\n' $((SECONDS - started))
}

# --- packages of the system

missing_packages() {
  if command -v dpkg-query >/dev/null; then
    comm -23 <(printf '%s\n' "$@" | sort) \
      <(dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^ii *//p' | sort)
  else  # a system of another kind: its compilers and Python are looked for, CMake names a library that is missing
    local command
    for command in g++ cmake ninja python3; do command -v $command >/dev/null || echo $command; done
  fi
}

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

# dpkg first ends what an interrupted run began.
apt_install() {
  local options=(-q -o DPkg::Lock::Timeout=600 -o APT::Keep-Downloaded-Packages=false)
  as_root dpkg --configure -a && as_root apt-get update "${options[@]}" &&
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${options[@]}" "$@"
}

install_packages() {
  local missing system
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  # shellcheck source=/dev/null
  system=$(. /etc/os-release 2>/dev/null && echo "${ID:-}-${VERSION_ID:-}")
  [[ $systems == *" $system "* ]] ||
    stop "install these first, named as in Debian (this script knows Debian 12 and 13 and Ubuntu 24.04): ${missing[*]}"
  [ "$(id -u)" -eq 0 ] || sudo -v || stop "needs root or sudo to install ${missing[*]}"  # here it may ask for a password
  step "${#missing[@]} packages of the system (about 1 min)" apt_install "${missing[@]}"
}

# --- Python

# Python 3.11 or newer with venv and headers; DMPCPP_PYTHON names another than the system's.
find_python() {
  local candidate candidates=(/usr/bin/python3 python3.13 python3.12 python3.11)
  [ -z "${DMPCPP_PYTHON:-}" ] || candidates=("$DMPCPP_PYTHON")
  for candidate in "${candidates[@]}"; do
    "$candidate" -c 'import ensurepip, pathlib, sys, sysconfig, venv
sys.exit(sys.version_info < (3, 11) or not pathlib.Path(sysconfig.get_path("include"), "Python.h").exists())' 2>/dev/null &&
      { echo "$candidate"; return; }
  done
  stop "needs Python 3.11 or newer with venv and headers (python3-venv, python3-dev); DMPCPP_PYTHON names one."
}

pip() { "$venv/bin/python" -m pip --disable-pip-version-check "$@"; }

# .venv is there, works, and is of the Python that DMPCPP_PYTHON names, where it names one.
has_venv() {
  "$venv/bin/python" -m pip --version >/dev/null 2>&1 || return
  [ -z "${DMPCPP_PYTHON:-}" ] || [ "$(base_python "$venv/bin/python")" = "$(base_python "$DMPCPP_PYTHON")" ]
}
base_python() { "$1" -c 'import sys; print(sys.base_prefix, sys.version)' 2>/dev/null; }

make_venv() {
  local python
  has_venv && return
  python=$(find_python) || exit 1
  "$python" -c 'import sys
if sys.version_info >= (3, 14):
    print("dmpcpp: Python %d.%d is newer than those that are tested, 3.11 to 3.13" % sys.version_info[:2])'
  step "Python environment in .venv" "$python" -m venv --clear "$venv"
  rm -f "$build/CMakeCache.txt" "$build"/built-* "$root"/python/dmpcpp/_core.*.so  # of another Python
}

# A wheel of the package index or one that was compiled here before; else it is compiled, by one checkout at a time.
pip_bullet() { pip "$@" --no-deps --find-links "$cache" "pybullet>=3.2.5"; }
install_bullet_wheel() { pip_bullet install --only-binary :all:; }
install_bullet() {
  flock 8
  install_bullet_wheel || { compile_bullet && install_bullet_wheel; }
  strip --strip-debug "$venv"/lib/python3*/site-packages/pybullet.*.so  # 130 MB in the wheels of the index
} 8>>"$cache/lock"

# Not isolated, so that it finds numpy: without it a picture is a list of numbers, and a film takes minutes. Its use of numpy
# is an error for GCC 14 unless this one check is off.
compile_bullet() {
  pip install "numpy>=1.26" "setuptools<81" wheel && CFLAGS="-O2 -g0 -w -Wno-incompatible-pointer-types" pip_bullet wheel --no-build-isolation -w "$cache"
}

installed() { "$venv/bin/python" -c 'import importlib.util as u, sys; sys.exit(not u.find_spec(sys.argv[1]))' "$1"; }

# install_python NAME EXTRA...: what pyproject.toml names for these, and dmpcpp itself as an editable install: Python runs
# python/dmpcpp where it lies, and build/release holds its compiled module.
install_python() {
  local stamp=$venv/dmpcpp-$1 extras state
  shift
  extras=$(IFS=,; echo "$*")
  state=$({ echo "$root $extras"; "$venv/bin/python" -V; cat "$root/pyproject.toml"; grep '^project' "$root/CMakeLists.txt"; } | sha256sum)
  [ "$(cat "$stamp" 2>/dev/null)" = "$state" ] && return
  step "Python packages for $extras (about 1 min)" pip install "pybind11>=3,<4" \
    -e "$root[$extras]" --config-settings wheel.cmake=false --config-settings editable.mode=inplace
  echo "$state" >"$stamp"
}

# --- C++

# is_configured NAME=VALUE ...: the build tree is there, with these in its cache.
is_configured() {
  local entry
  [ -e "$build/build.ninja" ] || return
  for entry in "$@"; do grep -q "^${entry%%=*}:[A-Z]*=${entry#*=}$" "$build/CMakeCache.txt" || return; done
}

# build TARGET MINUTES [OPTION=VALUE ...]: all, or _core, the Python module alone. Nothing is compiled twice.
build() {
  local what="compiling the C++ (about $2 min)" python="Python_EXECUTABLE=$venv/bin/python" options=("${@:3}")
  is_configured "$python" || rm -f "$build/CMakeCache.txt" "$build"/built-*  # there is none, or of another place
  is_configured "$python" "${options[@]}" || step "configuring the C++ in build/release" \
    cmake --preset release -S "$root" -DDMP_TESTS=OFF -DDMP_PYTHON=ON "-D$python" "${options[@]/#/-D}"
  [ ! -e "$build/built-$1" ] || what="bringing the C++ up to date"
  step "$what" cmake --build "$build" --target "$1" -j "$(nproc)"
  touch "$build/built-$1"
  ln -sf "$build"/python/bindings/_core.*.so "$root/python/dmpcpp/"
}

# The options of set-up; `arguments` keeps what is left for the program.
read_options() {
  bullet=bullet more_extras=() arguments=()
  while [ $# -gt 0 ]; do
    case $1 in
      --without-bullet) bullet=mujoco ;;
      --with) mapfile -td, more_extras < <(printf %s "${2:?dmpcpp: --with needs extras of pyproject.toml: --with bench,docs}") && shift ;;
      *) arguments+=("$1") ;;
    esac
    shift
  done
}

# set_up demo|test [OPTION ...]: all that the script needs.
set_up() {
  local purpose=$1
  read_options "${@:2}"
  mkdir -p "$root/build" "$cache" || stop "needs to write to $root"
  exec 9>"$root/build/setup.lock"  # one set-up of a checkout at a time
  flock 9
  echo "=== $purpose, $(date)" >>"$log"
  local -n packages=packages_$purpose extras=extras_$purpose
  install_packages "${packages[@]}"
  make_venv
  [ $bullet = mujoco ] || installed pybullet ||
    step "PyBullet (seconds, or 4 min to compile it where no wheel fits)" install_bullet
  install_python "$purpose-$bullet" "$bullet" "${extras[@]}" "${more_extras[@]}"
  if [ "$purpose" = demo ]; then build _core 2; else build all 4 DMP_TESTS=ON; fi
  installed pybullet_data || step "arms and motions of PyBullet without itself (100 MB)" "$venv/bin/python" -m dmpcpp fetch
  exec 9>&-
}

# For scripts/check.sh: compilers with sanitizers and fuzzers, tools of packages.
set_up_checks() {
  install_packages "${packages_check[@]}"
  pip install -q gcovr atheris
}
