#!/usr/bin/env bash
# Sets everything up and shows the main job: a person's motion, learned, carried out by a robot arm under physics.
# Arguments go to `dmpcpp demo`.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
exec "$venv/bin/dmpcpp" demo "$@"
