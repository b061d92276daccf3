"""Shell completion, as docs/command-line.md sets it up."""

import os
import subprocess
import sys

import pytest

PROGRAM = "import sys; sys.argv = ['dmpcpp']; from dmpcpp.cli import main; main()"


def complete(instruction, words=""):
    asked = {"_DMPCPP_COMPLETE": instruction, "COMP_WORDS": words, "COMP_CWORD": str(len(words.split()) - 1)}
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, env=os.environ | asked)
    return done.stdout


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_every_shell_gets_its_script(shell):
    assert "_DMPCPP_COMPLETE" in complete(f"{shell}_source")


def test_commands_options_and_choices_are_completed():
    assert complete("bash_complete", "dmpcpp im") == "plain,imitate\n"
    assert "plain,--quat-order" in complete("bash_complete", "dmpcpp fit --quat")
    assert complete("bash_complete", "dmpcpp batch --simulator mu") == "plain,mujoco\n"
