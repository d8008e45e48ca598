"""`stillwater analyse`: a clip taken apart into a file, and what it says of bad input."""

import shutil
import subprocess

import numpy as np
import pytest
import stillwater
from scipy.ndimage import gaussian_filter

pytestmark = pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed: there is no clip to read")

WIDTH, HEIGHT, FRAMES = 96, 64, 12


@pytest.fixture
def clip(tmp_path):
    """Noise that runs to the right by 2 px a frame."""
    wide = gaussian_filter(np.random.default_rng(1).normal(size=(HEIGHT, WIDTH + 2 * FRAMES, 1)), (2, 2, 0))
    frames = np.array([wide[:, 2 * (FRAMES - t) :][:, :WIDTH] for t in range(FRAMES)]).repeat(3, axis=3)
    pixels = (127 + 250 * frames).clip(0, 255).astype(np.uint8)
    coding = f"ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s {WIDTH}x{HEIGHT} -r 24 -i - -c:v libx264 -qp 2".split()
    subprocess.run([*coding, str(tmp_path / "clip.mp4")], input=pixels.tobytes(), check=True, timeout=60)
    return tmp_path


def test_a_clip_is_taken_apart(clip, command):
    done = command("analyse", "clip.mp4", "-o", "a.npz", cwd=clip)
    assert done.returncode == 0
    assert f"frames     {FRAMES} of {WIDTH} x {HEIGHT} px, 24 a second" in done.stdout and "px a frame" in done.stdout
    found, expected = stillwater.read_analysis(clip / "a.npz"), stillwater.analyse(clip / "clip.mp4")
    assert np.array_equal(found.residuals, expected.residuals) and np.array_equal(found.velocity, expected.velocity)
    assert "stillwater: warning: clip: the whole picture moves as one" in done.stderr


@pytest.mark.parametrize("option", [["--frames", "2-9"], ["--flow", "features"], ["--quality", "fast"], ["--steady"], ["--memory", "3"]])
def test_each_option_counts(clip, command, option):
    assert command("analyse", "clip.mp4", "-o", "a.npz", cwd=clip).returncode == 0
    assert command("analyse", "clip.mp4", "-o", "b.npz", *option, cwd=clip).returncode == 0
    a, b = (stillwater.read_analysis(clip / name) for name in ("a.npz", "b.npz"))
    assert not (np.array_equal(a.velocity, b.velocity) and np.array_equal(a.residuals, b.residuals))


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["gone.mp4", "-o", "a.npz"], "gone.mp4"),
        (["clip.mp4", "-o", "a.txt"], "a.txt: its ending is not one of .npz"),
        (["clip.mp4", "-o", "a.npz", "--frames", "4-40"], "clip.mp4: clip_frames: 40 is not a frame of the clip (1 to 12)"),
        (["clip.mp4", "-o", "a.npz", "--frames", "x"], "x is not a frame or FIRST-LAST"),
        (["clip.mp4", "-o", "a.npz", "--memory", "0.01"], "MB do not hold the clip"),
    ],
)
def test_bad_input_is_one_sentence_and_code_2(clip, command, arguments, sentence):
    done = command("analyse", *arguments, cwd=clip)
    assert done.returncode == 2 and sentence in done.stderr and "Traceback" not in done.stderr
    assert sorted(path.name for path in clip.iterdir()) == ["clip.mp4"]
