"""Measurements beside other packages, each in one run: `python -m benchmarks.accuracy`."""
