"""Histories are notes that know their kind."""

import copy
import pickle

import pytest
from dmpcpp.cli._tables import note_style
from dmpcpp.recordings import Note

from tests.python.motions import screw


def test_a_note_is_its_text_and_knows_its_kind():
    note = Note("assumed", "no length unit given: positions taken as metres", about="unit")
    assert note == "no length unit given: positions taken as metres"
    assert (note.kind, note.text, note.about) == ("assumed", str(note), "unit")
    doubtful = Note("warning", "the header announces 5 rows, the file holds 4")
    assert doubtful == "WARNING: the header announces 5 rows, the file holds 4"
    assert doubtful.text == "the header announces 5 rows, the file holds 4"


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="kind: 'told', expected one of changed, assumed, warning"):
        Note("told", "something")


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda note: pickle.loads(pickle.dumps(note))])
def test_a_note_keeps_its_kind_as_a_copy(again):
    note = again(Note("warning", "doubtful", about="rate"))
    assert (note, note.kind, note.text, note.about) == ("WARNING: doubtful", "warning", "doubtful", "rate")


def test_a_recording_holds_notes_and_plain_text_counts_as_a_change():
    recording = screw().with_("cropped").with_(Note("warning", "fast"))
    assert [note.kind for note in recording.history] == ["changed", "warning"]
    assert recording.history[-1].text == "fast"


def test_what_warns_and_what_is_assumed_is_not_printed_dim():
    assert note_style(Note("warning", "x")) == "bold yellow"
    assert note_style(Note("assumed", "x")) == "yellow"
    assert note_style(Note("changed", "x")) == note_style("x") == "dim"
