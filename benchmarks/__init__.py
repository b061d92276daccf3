"""Measurements beside other packages, each in one run: `python -m benchmarks.accuracy`, `.speed` and so on.

Times are compared with one thread on either side.
"""

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
