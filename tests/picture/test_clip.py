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
    ffmpeg(*raw, "-pix_fmt", "yuv420p", "-c:v", "libvpx-vp9", "-crf", 10, "-b:v", 0, "-deadline", "realtime", folder / "altref.webm")
    ffmpeg(*raw, "-pix_fmt", "rgb24", "-c:v", "ffv1", folder / "lossless.mkv")
    ffmpeg("-ss", "0.7", "-i", folder / "b-frames.mp4", "-c", "copy", folder / "cut.mp4")
    return folder


@pytest.mark.parametrize("name", ["b-frames.mp4", "no-b-frames.avi", "ten-bits.mov", "altref.webm", "lossless.mkv"])
def test_each_frame_is_the_one_that_was_filmed(folder, name):
    frames = read_clip(folder / name)
    assert frames.shape == (FRAMES, HEIGHT, WIDTH, 3)
    assert frames.dtype == np.float32
    expected = [level(n) for n in range(1, FRAMES + 1)]
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


@pytest.mark.parametrize("width", [2, 18, 50, 426, 600])
def test_rows_that_are_no_whole_vectors(tmp_path, width):
    """swscale writes sixteen pixels at a time; others' reader lost memory there."""
    ramp = np.broadcast_to(np.linspace(0, 255, width).round().astype(np.uint8)[None, None, :, None], (3, 34, width, 3))
    (tmp_path / "raw.rgb").write_bytes(np.ascontiguousarray(ramp).tobytes())
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x34", "-r", "25", "-i", tmp_path / "raw.rgb"]
    for pixels, tolerance in (("yuv444p", 0.01), ("rgb24", 1e-6), ("gbrp10le", 0.005)):
        ffmpeg(*raw, "-pix_fmt", pixels, "-c:v", "ffv1", tmp_path / "ramp.mkv")
        for _ in range(5):
            np.testing.assert_allclose(read_clip(tmp_path / "ramp.mkv"), ramp / 255, atol=tolerance)


@pytest.mark.parametrize(("height", "said", "matrix"), [(48, "", "bt601"), (720, "", "bt709"), (48, "bt709", "bt709")])
def test_colours_are_those_of_the_file_s_matrix(tmp_path, height, said, matrix):
    colour = np.array([200, 60, 30], np.uint8)
    (tmp_path / "raw.rgb").write_bytes(np.broadcast_to(colour, (2, height, 64, 3)).tobytes())
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"64x{height}", "-r", "25", "-i", tmp_path / "raw.rgb"]
    tags = ["-colorspace", said] if said else []
    ffmpeg(*raw, "-vf", f"scale=out_color_matrix={matrix}", "-pix_fmt", "yuv444p", *tags, "-c:v", "libx264", "-qp", 0, tmp_path / "c.mp4")  # fmt: skip
    np.testing.assert_allclose(read_clip(tmp_path / "c.mp4")[0, 9, 9], colour / 255, atol=0.012)


@pytest.mark.parametrize("turn", [90, 180, 270])
def test_a_clip_that_was_filmed_with_the_camera_turned_is_upright(folder, tmp_path, turn):
    turned, straight = tmp_path / "turned.mp4", ["-i", folder / "b-frames.mp4", "-c", "copy"]
    try:
        ffmpeg("-display_rotation", turn, *straight, turned)
    except subprocess.CalledProcessError:  # before FFmpeg 6
        ffmpeg(*straight, "-metadata:s:v", f"rotate={turn}", turned)
    ffmpeg("-i", turned, "-pix_fmt", "rgb24", "-f", "rawvideo", tmp_path / "upright.rgb")  # ffmpeg turns by itself
    clip, shape = engine.Clip(str(turned)), (WIDTH, HEIGHT) if turn % 180 else (HEIGHT, WIDTH)
    assert (clip.height, clip.width) == shape
    upright = np.frombuffer((tmp_path / "upright.rgb").read_bytes(), np.uint8).reshape(FRAMES, *shape, 3)
    np.testing.assert_allclose(read_clip(turned), upright / 255, atol=0.02)


@pytest.mark.parametrize("pixels, coding, tolerance", [("rgba", "png", 1e-5), ("yuva444p10le", "prores_ks", 0.01)])
def test_what_is_transparent_lies_over_black(tmp_path, pixels, coding, tolerance):
    frames = np.empty((3, 48, 64, 4), np.uint8)
    frames[..., :3] = (200, 120, 40)
    frames[..., 3] = np.linspace(0, 255, 64).round()
    (tmp_path / "raw.rgba").write_bytes(frames.tobytes())
    raw = ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", "64x48", "-r", "25", "-i", tmp_path / "raw.rgba"]
    ffmpeg(*raw, "-pix_fmt", pixels, "-c:v", coding, tmp_path / "clip.mov")
    straight = frames[..., :3] / 255
    linear = np.where(straight <= 0.04045, straight / 12.92, ((straight + 0.055) / 1.055) ** 2.4) * (frames[..., 3:] / 255)
    shown = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    clip = engine.Clip(str(tmp_path / "clip.mov"))
    assert not clip.seen_transparent
    np.testing.assert_allclose(clip.frame(2, 64, 48), shown[1], atol=tolerance)
    assert clip.seen_transparent


def test_a_clip_with_an_alpha_that_is_full_everywhere(tmp_path):
    (tmp_path / "raw.rgba").write_bytes(np.full((3, 48, 64, 4), 255, np.uint8).tobytes())
    raw = ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", "64x48", "-r", "25", "-i", tmp_path / "raw.rgba"]
    for coding in (["-pix_fmt", "rgba", "-c:v", "png"], ["-pix_fmt", "yuva444p10le", "-c:v", "prores_ks"]):
        ffmpeg(*raw, *coding, tmp_path / "clip.mov")
        clip = engine.Clip(str(tmp_path / "clip.mov"))
        np.testing.assert_allclose(clip.frame(1, 64, 48), 1, atol=0.005)
        assert not clip.seen_transparent


def test_a_file_without_video(tmp_path):
    ffmpeg("-f", "lavfi", "-i", "sine=duration=1", tmp_path / "tone.mp4")
    with pytest.raises(OSError, match="tone.mp4: holds no video$"):
        read_clip(tmp_path / "tone.mp4")


def test_frames_that_are_missing_at_the_end(folder, tmp_path):
    """A file whose header promises more than it holds."""
    whole = (folder / "lossless.mkv").read_bytes()
    (tmp_path / "short.mkv").write_bytes(whole[: len(whole) * 2 // 3])
    clip = engine.Clip(str(tmp_path / "short.mkv"))
    assert 0 < clip.frames < FRAMES
    np.testing.assert_array_equal(read_clip(tmp_path / "short.mkv"), read_clip(folder / "lossless.mkv", (1, clip.frames)))


def test_smaller_frames_are_averaged_over_areas(folder):
    whole = read_clip(folder / "b-frames.mp4", (3, 4))
    small = read_clip(folder / "b-frames.mp4", (3, 4), (16, 12))
    np.testing.assert_allclose(small, whole.reshape(2, 12, 4, 16, 4, 3).mean((2, 4)), atol=1e-6)


def test_larger_frames_are_interpolated(folder):
    whole = read_clip(folder / "b-frames.mp4", (3, 3))[0]
    large = read_clip(folder / "b-frames.mp4", (3, 3), (3 * WIDTH, 3 * HEIGHT))[0]
    assert large.shape == (3 * HEIGHT, 3 * WIDTH, 3)
    np.testing.assert_allclose(large[1::3, 1::3], whole, atol=1e-6)  # centres of pixels fall on centres of pixels
    assert whole.min() <= large.min() + 1e-6 and large.max() <= whole.max() + 1e-6


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
