"""Messages of the library in the words of the command line."""

import pytest
from dmpcpp.cli import _flags

FLAGS = {"low_pass": "--low-pass", "time_unit": "--time-unit", "start": "--start"}


@pytest.mark.parametrize(
    ("message", "typed"),
    [
        ("low_pass: -1, expected a frequency in Hz.", "--low-pass: -1, expected a frequency in Hz."),
        ("State time_unit='ms'.", "State --time-unit ms."),
        ("/data/low_pass.csv: No such file or directory", "/data/low_pass.csv: No such file or directory"),
        ("column 'time_unit' is no number", "column 'time_unit' is no number"),
        ("/data/start=1/x.csv: No such file", "/data/start=1/x.csv: No such file"),
    ],
)
def test_a_parameter_becomes_its_option_and_a_path_or_a_quoted_name_stays(message: str, typed: str) -> None:
    assert _flags.in_flags(message, FLAGS) == typed
