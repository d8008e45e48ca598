"""A finished frame is read back: what was written, whatever layers stand beside it."""

import numpy as np
import pytest
from stillwater import _stillwater as engine


@pytest.fixture
def picture():
    straight = np.random.default_rng(1).uniform(0, 1, (5, 7, 4)).astype(np.float32)
    straight[..., :3] *= straight[..., 3:]
    return straight


def test_a_frame_comes_back(tmp_path, picture):
    path = str(tmp_path / "frame_0001.exr")
    beside = [("A layer", np.zeros_like(picture)), ("zebra", np.ones_like(picture))]
    engine.write_frame(path, picture, layers=beside, options=engine.FrameOptions(half=False))
    np.testing.assert_allclose(engine.read_frame(path), picture, atol=2e-6)


def test_eight_bits_come_back_through_half_floats(tmp_path):
    picture = np.ones((16, 16, 4), np.float32)
    picture[..., :3] = (np.arange(256).reshape(16, 16, 1) / 255).astype(np.float32)
    engine.write_frame(str(tmp_path / "f.exr"), picture)
    assert (np.rint(engine.read_frame(str(tmp_path / "f.exr")) * 255) == np.rint(picture * 255)).all()


def test_another_picture_is_no_frame(tmp_path, picture):
    path = str(tmp_path / "other.exr")
    engine.write_picture(path, picture)
    with pytest.raises(engine.BadInput, match=r"other\.exr: is not a frame \(it has no Stillwater\.Combined\)"):
        engine.read_frame(path)


def test_no_file_is_a_sentence(tmp_path):
    with pytest.raises(engine.FileError, match="none.exr"):
        engine.read_frame(str(tmp_path / "none.exr"))
