"""Files of clips taken apart: which frames, how much memory, what is odd; kept in a file of their own."""

import shutil

import numpy as np
import pytest
import stillwater
from clips import HEIGHT, WIDTH, boiling, carried, write
from scipy.ndimage import shift

pytestmark = pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed: there is no clip to read")


@pytest.fixture(scope="module")
def clip(tmp_path_factory):
    return write(tmp_path_factory.mktemp("clip") / "clip.mp4", carried((2, 1), 20))


def test_a_clip_is_taken_apart(clip):
    found = stillwater.analyse(clip)
    assert found.residuals.shape == (20, HEIGHT, WIDTH, 3) and found.residuals.dtype == np.float16
    assert found.fps == 24 and found.warnings == []
    np.testing.assert_allclose(found.velocity[16:-16, 16:-16].mean(axis=(0, 1)), (2, 1), atol=0.1)
    np.testing.assert_allclose(found.average, stillwater.read_clip(clip).mean(axis=0), atol=1e-3)


def test_only_the_frames_asked_for_are_taken(clip):
    found = stillwater.analyse(clip, (4, 11))
    assert len(found.residuals) == 8
    np.testing.assert_allclose(found.average, stillwater.read_clip(clip, (4, 11)).mean(axis=0), atol=1e-3)


def test_features_and_qualities_are_other_flows(clip):
    flows = [stillwater.analyse(clip, flow=flow, quality=quality).velocity
             for flow, quality in (("dense", "fast"), ("dense", "medium"), ("dense", "best"), ("features", "medium"))]  # fmt: skip
    assert all(not np.array_equal(a, b) for i, a in enumerate(flows) for b in flows[:i])


def test_what_does_not_fit_is_made_smaller(clip):
    found = stillwater.analyse(clip, memory=3)
    _, height, width, _ = found.residuals.shape
    assert height < HEIGHT and width / height == pytest.approx(WIDTH / HEIGHT, rel=0.03)
    assert found.warnings == [f"clip: 20 frames of {WIDTH} x {HEIGHT} are more than 3 MB hold; taken at {width} x {height}"]


def test_frames_that_repeat_are_left_out(tmp_path):
    frames = np.repeat(carried((2, 1), 12), 2, axis=0)
    found = stillwater.analyse(write(tmp_path / "twice.mp4", frames))
    assert len(found.residuals) == 12 and found.fps == 12
    assert found.warnings == ["clip: 12 frames repeat the one before and are left out; taken as 12 frames per second"]


def test_one_repeated_frame_is_told_as_one(tmp_path):
    frames = carried((2, 1), 12)
    found = stillwater.analyse(write(tmp_path / "once.mp4", np.insert(frames, 5, frames[5], axis=0)))
    assert "clip: 1 frame repeats the one before and is left out" in found.warnings[0]


def panned(frames, way):
    """A still texture, filmed by a camera that moves, with a boiling pool in it."""
    wide = boiling(1, 1.0, seed=9)[0]
    pool = boiling(frames)
    clip = np.array([shift(wide, (way[1] * t, way[0] * t, 0), order=1, mode="mirror") for t in range(frames)])
    clip[:, 40:60, 50:80] = pool[:, 40:60, 50:80]
    return clip


def test_a_clip_that_moves_as_a_whole_is_said(tmp_path):
    found = stillwater.analyse(write(tmp_path / "pan.mp4", panned(20, (0.8, 0.3))))
    assert any("the whole picture moves as one" in sentence for sentence in found.warnings)
    still = stillwater.analyse(write(tmp_path / "still.mp4", panned(20, (0, 0))))
    assert still.warnings == []


def test_shake_is_taken_out_when_asked(tmp_path):
    rng = np.random.default_rng(2)
    ways = np.cumsum(rng.normal(0, 1.2, (20, 2)), axis=0)
    wide = boiling(1, 1.0, seed=9)[0]
    shaken = np.array([shift(wide, (y, x, 0), order=1, mode="mirror") for x, y in ways])
    path = write(tmp_path / "shaken.mp4", shaken)
    loose, held = stillwater.analyse(path), stillwater.analyse(path, steady=True)
    inside = (slice(1, None), slice(12, -12), slice(12, -12))
    assert np.square(held.residuals[inside].astype(float)).mean() < 0.5 * np.square(loose.residuals[inside].astype(float)).mean()
    assert any("held still; the camera shook by up to" in sentence for sentence in held.warnings)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"frames": (9, 3)}, r"clip_frames: \[9, 3\] runs backwards"),
        ({"frames": (1, 21)}, "clip_frames: 21 is not a frame of the clip"),
        ({"frames": (5, 5)}, "clip_frames: 1 frame is not at least 3"),
        ({"frames": (5, 6)}, "clip_frames: 2 frames are not at least 3"),
        ({"memory": 0.1}, "memory: 0 MB do not hold the clip"),
    ],
)
def test_what_cannot_be_taken_is_said(clip, arguments, sentence):
    with pytest.raises(ValueError, match=sentence):
        stillwater.analyse(clip, **arguments)


def test_a_clip_without_motion_and_a_tiny_one_are_refused(tmp_path):
    with pytest.raises(ValueError, match="nothing moves in it"):
        stillwater.analyse(write(tmp_path / "still.mp4", np.full((8, 64, 64, 3), 0.4)))
    with pytest.raises(ValueError, match="24 x 24 is not at least 32 px a side"):
        stillwater.analyse(write(tmp_path / "tiny.mp4", carried((1, 0), 8)[:, :24, :24]))


def test_a_file_that_is_no_clip_is_named(tmp_path):
    (tmp_path / "no.mp4").write_bytes(b"no clip at all")
    with pytest.raises(OSError, match="no.mp4"):
        stillwater.analyse(tmp_path / "no.mp4")
    with pytest.raises(OSError, match="gone.mp4"):
        stillwater.analyse(tmp_path / "gone.mp4")


def test_a_clip_cut_short_gives_the_frames_that_are_there(tmp_path, clip):
    whole = write(tmp_path / "whole.mkv", carried((2, 1), 20), 24, "-c:v", "ffv1", "-g", "1")
    data = whole.read_bytes()
    (tmp_path / "cut.mkv").write_bytes(data[: len(data) * 2 // 3])
    found = stillwater.analyse(tmp_path / "cut.mkv")
    assert 8 <= len(found.residuals) < 20


def test_an_analysis_is_kept_in_a_file(tmp_path, clip):
    found = stillwater.analyse(clip, memory=3)
    stillwater.write_analysis(tmp_path / "a.npz", found)
    again = stillwater.read_analysis(tmp_path / "a.npz")
    for name in found.__dataclass_fields__:
        assert np.array_equal(getattr(found, name), getattr(again, name))
    assert [path.name for path in tmp_path.iterdir()] == ["a.npz"]


def test_what_is_no_analysis_is_refused(tmp_path, clip):
    np.savez(tmp_path / "other.npz", x=np.zeros(3))
    with pytest.raises(ValueError, match="not the analysis of a clip"):
        stillwater.read_analysis(tmp_path / "other.npz")
    with pytest.raises(ValueError, match="its ending is not .npz"):
        stillwater.write_analysis(tmp_path / "a.txt", stillwater.analyse(clip, (1, 4)))
    with pytest.raises(OSError, match="none"):
        stillwater.write_analysis(tmp_path / "none" / "a.npz", stillwater.analyse(clip, (1, 4)))


def test_it_can_be_cancelled_while_it_reads(clip):
    with pytest.raises(stillwater.Cancelled):
        stillwater.analyse(clip, progress=lambda phase, share: phase != "reading the clip")
