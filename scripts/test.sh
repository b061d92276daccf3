#!/usr/bin/env bash
# Sets everything up and runs ctest and pytest on all processors; a failure, or a suite that ran nothing, is a failure.
# Arguments go to pytest (--slow adds the long tests); --without-bullet leaves PyBullet out, --with bench,docs,cluster adds
# what some tests compare with. The last lines say what was left out and what runs it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
set_up test "$@"
cd "$root"
processors=$(nproc)
ctest --preset release -j "$processors"
"$venv/bin/python" -m pytest -n "$processors" "${arguments[@]}"
