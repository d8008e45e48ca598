"""Flow fields in files: .flo byte by byte, EXR channels, and what is refused."""

import os
import struct

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine

FLOW = np.random.default_rng(2).standard_normal((5, 7, 2)).astype(np.float32)


def flo(width=7, height=5, mark=b"PIEH", body=None):
    return mark + struct.pack("<ii", width, height) + (FLOW.tobytes() if body is None else body)


def refused(path, sentence, error=stillwater.FileError):
    with pytest.raises(error) as caught:
        stillwater.read_flow(path)
    assert str(caught.value) == f"{path}: {sentence}"


@pytest.mark.parametrize("name", ["a.flo", "a.exr", "a.FLO"])
def test_what_is_written_is_read(tmp_path, name):
    stillwater.write_flow(tmp_path / name, FLOW)
    assert np.array_equal(stillwater.read_flow(tmp_path / name), FLOW)
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_flo_is_middlebury_s(tmp_path):
    stillwater.write_flow(tmp_path / "a.flo", FLOW)
    assert (tmp_path / "a.flo").read_bytes() == flo()


def test_exr_has_channels_x_and_y(tmp_path):
    stillwater.write_flow(tmp_path / "a.exr", FLOW)
    facts = engine.inspect_picture(str(tmp_path / "a.exr"))
    assert (facts.channel_names, facts.pixel_type, facts.width, facts.height) == (["X", "Y"], "float", 7, 5)
    first = (tmp_path / "a.exr").read_bytes()
    stillwater.write_flow(tmp_path / "a.exr", FLOW)
    assert (tmp_path / "a.exr").read_bytes() == first


def test_a_rendered_frame_s_flow_is_read(tmp_path):
    engine.write_frame(str(tmp_path / "f.exr"), np.zeros((5, 7, 4), np.float32), FLOW)
    assert np.abs(stillwater.read_flow(tmp_path / "f.exr") - FLOW).max() < 1e-3


def test_unknown_flow_counts_as_none(tmp_path):
    body = FLOW.copy()
    body[1, 2] = 1.6e9
    (tmp_path / "a.flo").write_bytes(flo(body=body.tobytes()))
    read = stillwater.read_flow(tmp_path / "a.flo")
    assert (read[1, 2] == 0).all() and np.array_equal(read[2:], FLOW[2:])


@pytest.mark.parametrize(
    "data, sentence",
    [
        (b"", "the file is empty"),
        (b"PI", "is not a flow file (it does not begin with PIEH)"),
        (flo(mark=b"HEIP"), "is not a flow file (it does not begin with PIEH)"),
        (b"PIEH\x07\0\0", "is cut short or damaged"),
        (flo()[:-1], "is cut short or damaged"),
    ],
)
def test_damaged_flo(tmp_path, data, sentence):
    (tmp_path / "a.flo").write_bytes(data)
    refused(tmp_path / "a.flo", sentence)


@pytest.mark.parametrize("width, height", [(0, 5), (-3, 5), (99999, 5)])
def test_flo_of_a_size_that_no_picture_has(tmp_path, width, height):
    (tmp_path / "a.flo").write_bytes(flo(width, height))
    refused(tmp_path / "a.flo", f"{width} x {height} is not between 1 and 16384 pixels a side", stillwater.BadInput)


def test_numbers_that_are_none(tmp_path):
    body = FLOW.copy()
    body[1, 2, 1] = np.nan
    (tmp_path / "a.flo").write_bytes(flo(body=body.tobytes()))
    refused(tmp_path / "a.flo", "pixel [1, 2] is not finite numbers", stillwater.BadInput)


def test_exr_without_flow(tmp_path):
    stillwater.write(tmp_path / "a.exr", np.zeros((5, 7, 3)))
    refused(tmp_path / "a.exr", "its channels (R, G, B, A) are not X and Y", stillwater.BadInput)


def test_damaged_exr(tmp_path):
    stillwater.write_flow(tmp_path / "a.exr", np.random.default_rng(1).random((200, 200, 2)))
    os.truncate(tmp_path / "a.exr", 9000)
    with pytest.raises(stillwater.FileError, match="is cut short or damaged"):
        stillwater.read_flow(tmp_path / "a.exr")


def test_missing_and_other_files(tmp_path):
    refused(tmp_path / "none.flo", "there is no such file")
    refused(tmp_path / "none.exr", "there is no such file")
    refused(tmp_path / "a.png", "its extension is not .flo or .exr", stillwater.BadInput)
    (tmp_path / "folder.flo").mkdir()
    refused(tmp_path / "folder.flo", "is a folder, not a file")


@pytest.mark.parametrize("name", ["none/a.flo", "none/a.exr"])
def test_where_nothing_can_be_written(tmp_path, name):
    with pytest.raises(stillwater.FileError) as caught:
        stillwater.write_flow(tmp_path / name, FLOW)
    assert str(caught.value) == f"{tmp_path / name}: cannot be written (No such file or directory)"


def test_what_is_no_flow_is_not_written(tmp_path):
    with pytest.raises(stillwater.BadInput) as caught:
        stillwater.write_flow(tmp_path / "a.flo", FLOW[..., :1])
    assert str(caught.value) == "flow: an array of 5 x 7 x 1 is not height x width x 2"
    with pytest.raises(stillwater.BadInput) as caught:
        stillwater.write_flow(tmp_path / "a.png", FLOW)
    assert str(caught.value) == f"{tmp_path / 'a.png'}: its extension is not .flo or .exr"
    assert list(tmp_path.iterdir()) == []
