"""Frames are claimed before they are rendered: no two workers have one in common."""

import os

import pytest
from stillwater.render.claim import claim_frames
from stillwater.render.errors import Refused


def test_disjoint_frames_are_shared(tmp_path):
    with claim_frames(tmp_path, "frame", 1, 10), claim_frames(tmp_path, "frame", 11, 20), claim_frames(tmp_path, "frame", -5, 0):
        assert len(list(tmp_path.iterdir())) == 3
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("first, last", [(5, 5), (1, 5), (10, 12), (-3, 30)])
def test_frames_in_common_are_refused_and_whose_they_are_is_said(tmp_path, first, last):
    with claim_frames(tmp_path, "frame", 5, 10):
        with pytest.raises(Refused, match=rf"another worker \(process {os.getpid()} on .*\) is rendering the frames 5 to 10"):
            claim_frames(tmp_path, "frame", first, last)
        assert len(list(tmp_path.iterdir())) == 1
    claim_frames(tmp_path, "frame", first, last).release()


def test_frames_of_another_name_are_others(tmp_path):
    with claim_frames(tmp_path, "frame", 1, 10), claim_frames(tmp_path, "frame.left", 1, 10):
        pass


def test_claims_of_the_dead_are_cleared_away(tmp_path):
    (tmp_path / ".frame.1..10.99.claim").write_text("elsewhere 99 0123456789abcdef")
    os.utime(tmp_path / ".frame.1..10.99.claim", (0, 0))
    with claim_frames(tmp_path, "frame", 5, 6):
        assert [path.name for path in tmp_path.iterdir()] == [f".frame.5..6.{os.getpid()}.claim"]
