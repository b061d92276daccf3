#!/usr/bin/env bash
# Sets everything up and shows the main job: a person's motion, learned, carried out by a robot arm under physics.
# Arguments go to `dmpcpp demo`; --without-bullet needs no PyBullet, MuJoCo is the engine then.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
set_up demo "$@"
exec "$venv/bin/python" -m dmpcpp demo "${arguments[@]}"
