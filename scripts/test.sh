#!/usr/bin/env bash
# Sets everything up and runs ctest and pytest; a failure, or a suite that ran nothing, is a failure.
# Arguments go to pytest (--slow adds the long tests).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$root"
cmake --preset release >/dev/null || stop "cmake could not configure: see above."
cmake --build --preset release
ctest --preset release
"$venv/bin/python" -m pytest "$@"
