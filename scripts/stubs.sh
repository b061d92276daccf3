#!/usr/bin/env bash
# Writes the type stubs of dmpcpp._core anew from the installed module; a test holds them against it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
python=${PYTHON:-.venv/bin/python}
out=${1:-python/dmpcpp}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$python" -m pybind11_stubgen dmpcpp._core -o "$scratch" --numpy-array-use-type-var >/dev/null
rm -rf "$out/_core"
cp -r "$scratch/dmpcpp/_core" "$out/_core"
