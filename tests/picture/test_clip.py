"""Clips: any range, any order, the same frames; at a wanted size."""

import shutil
import subprocess

import numpy as np
import pytest
from stillwater import _stillwater as engine
from stillwater import read_clip

pytestmark = pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed: there is no clip to read")

WIDTH, HEIGHT, FRAMES = 64, 48, 40


def ffmpeg(*arguments):
    subprocess.run(["ffmpeg", "-v", "error", "-y", *map(str, arguments)], check=True, timeout=60)


def level(number):
    return 0.1 + 0.8 * ((number * 7) % FRAMES) / FRAMES


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A clip whose frame n is grey of level(n) with a white right half, in several codings."""
    folder = tmp_path_factory.mktemp("clips")
    frames = np.zeros((FRAMES, HEIGHT, WIDTH, 3), np.uint8)
    for n in range(FRAMES):
        frames[n] = round(255 * level(n + 1))
    frames[:, :, WIDTH // 2 :] = 255
    (folder / "raw.rgb").write_bytes(frames.tobytes())
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{WIDTH}x{HEIGHT}", "-r", "25", "-i", folder / "raw.rgb"]
    ffmpeg(*raw, "-pix_fmt", "yuv420p", "-c:v", "libx264", "-qp", 4, "-bf", 3, "-g", 250, folder / "b-frames.mp4")
    ffmpeg(*raw, "-pix_fmt", "yuv420p", "-c:v", "mpeg4", "-q:v", 1, "-g", 12, folder / "no-b-frames.avi")
    ffmpeg(*raw, "-pix_fmt", "yuv422p10le", "-c:v", "prores", folder / "ten-bits.mov")
    ffmpeg("-ss", "0.7", "-i", folder / "b-frames.mp4", "-c", "copy", folder / "cut.mp4")
    return folder


@pytest.mark.parametrize(("name", "held"), [("b-frames.mp4", 2), ("no-b-frames.avi", 0), ("ten-bits.mov", 0)])
def test_each_frame_is_the_one_that_was_filmed(folder, name, held):
    """`held`: frames at the end that OpenImageIO does not get out of the decoder, and repeats."""
    frames = read_clip(folder / name)
    assert frames.shape == (FRAMES, HEIGHT, WIDTH, 3)
    assert frames.dtype == np.float32
    last = FRAMES - held
    expected = [level(min(n, last)) for n in range(1, FRAMES + 1)]
    np.testing.assert_allclose(frames[:, HEIGHT // 2, WIDTH // 4].mean(-1), expected, atol=0.02)
    np.testing.assert_allclose(frames[:, HEIGHT // 2, 3 * WIDTH // 4], 1, atol=0.02)


@pytest.mark.parametrize("name", ["b-frames.mp4", "no-b-frames.avi", "ten-bits.mov", "cut.mp4"])
def test_any_order_gives_the_same_frames(folder, name):
    clip = engine.Clip(str(folder / name))
    whole = [clip.frame(n, WIDTH, HEIGHT) for n in range(1, clip.frames + 1)]
    for n in np.random.default_rng(1).integers(1, clip.frames + 1, 15):
        np.testing.assert_array_equal(clip.frame(int(n), WIDTH, HEIGHT), whole[n - 1])
    np.testing.assert_array_equal(read_clip(folder / name, (9, 11)), whole[8:11])


def test_what_a_clip_says_of_itself(folder):
    clip = engine.Clip(str(folder / "b-frames.mp4"))
    assert (clip.frames, clip.fps, clip.width, clip.height) == (FRAMES, 25, WIDTH, HEIGHT)


def test_smaller_frames_are_averaged_over_areas(folder):
    whole = read_clip(folder / "b-frames.mp4", (3, 4))
    small = read_clip(folder / "b-frames.mp4", (3, 4), (16, 12))
    np.testing.assert_allclose(small, whole.reshape(2, 12, 4, 16, 4, 3).mean((2, 4)), atol=1e-6)


def test_larger_frames_are_interpolated(folder):
    whole = read_clip(folder / "b-frames.mp4", (3, 3))[0]
    large = read_clip(folder / "b-frames.mp4", (3, 3), (3 * WIDTH, 3 * HEIGHT))[0]
    assert large.shape == (3 * HEIGHT, 3 * WIDTH, 3)
    np.testing.assert_allclose(large[1::3, 1::3], whole, atol=1e-6)  # centres of pixels fall on centres of pixels
    assert whole.min() <= large.min() and large.max() <= whole.max()


@pytest.mark.parametrize(
    ("frames", "size", "sentence"),
    [
        ((0, 4), None, "frames: 0 is not between 1 and 40"),
        ((5, 41), None, "frames: 41 is not between 1 and 40"),
        ((5, 4), None, "frames: 5 to 4 is not a range (first, last)"),
        ((1, 1), (0, 5), "size: 0 x 5 is not between 1 and 16384 pixels a side"),
        ((1, 1), (20000, 5), "size: 20000 x 5 is not between 1 and 16384 pixels a side"),
    ],
)
def test_ranges_and_sizes_that_are_not(folder, frames, size, sentence):
    with pytest.raises(engine.BadInput) as caught:
        read_clip(folder / "b-frames.mp4", frames, size)
    assert str(caught.value) == sentence


def test_a_picture_is_no_clip_and_a_clip_no_picture(folder, tmp_path):
    engine.write_picture(str(tmp_path / "p.png"), np.ones((4, 4, 4)))
    with pytest.raises(OSError, match="p.png: is a picture, not a clip$"):
        read_clip(tmp_path / "p.png")
    with pytest.raises(OSError, match="b-frames.mp4: is a clip, not a picture$"):
        engine.read_picture(str(folder / "b-frames.mp4"))


def test_a_clip_that_was_cut_short(folder, tmp_path):
    whole = (folder / "b-frames.mp4").read_bytes()
    (tmp_path / "c.mp4").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(OSError, match=r"c.mp4: is not a picture or clip that can be read"):
        read_clip(tmp_path / "c.mp4")
