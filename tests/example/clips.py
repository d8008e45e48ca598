"""Clips made of numbers: frames x height x width x 3, with a flow that is known."""

import subprocess

import numpy as np
from scipy.ndimage import gaussian_filter

HEIGHT, WIDTH = 96, 128
Y, X = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)


def waves(x, y, seed=0, shortest=12):
    """A band-limited texture, -1 .. 1: a sum of plane waves no shorter than `shortest` px, at places of any shape."""
    rng = np.random.default_rng(seed)
    total = np.zeros(np.broadcast(x, y).shape)
    for _ in range(12):
        length, angle, phase = rng.uniform(shortest, 3 * shortest), rng.uniform(0, 2 * np.pi), rng.uniform(0, 2 * np.pi)
        total += np.cos(2 * np.pi * (np.cos(angle) * x + np.sin(angle) * y) / length + phase)
    return total / 12


def coloured(grey, strength=0.25):
    return 0.5 + strength * np.stack([grey, 0.8 * grey, 0.6 * grey], axis=-1)


def carried(velocity, frames, seed=0, shortest=12):
    """A texture that moves evenly, and keeps changing slowly. `velocity`: px/frame."""
    clip = []
    for t in range(frames):
        x, y = X - velocity[0] * t, Y - velocity[1] * t
        clip.append(coloured(waves(x, y, seed, shortest) * np.cos(0.05 * t) + waves(x, y, seed + 1, shortest) * np.sin(0.05 * t)))
    return np.array(clip)


def turning(rate, frames):
    """A texture that turns about the middle, radians a frame."""
    clip = []
    for t in range(frames):
        c, s = np.cos(-rate * t), np.sin(-rate * t)
        x, y = X - WIDTH / 2, Y - HEIGHT / 2
        clip.append(coloured(waves(c * x - s * y, s * x + c * y, 5)))
    return np.array(clip)


def boiling(frames, size=2.0, seed=1):
    """Noise that is another one in each frame."""
    rng = np.random.default_rng(seed)
    noise = np.array([gaussian_filter(rng.normal(size=(HEIGHT, WIDTH)), size) for _ in range(frames)])
    return coloured(noise / noise.std(), 0.1)


def halves(clip):
    return np.ascontiguousarray(clip, np.float16)


def write(path, clip, fps=24, *coding):
    """Frames as a clip, nearly without loss."""
    frames = (np.clip(clip, 0, 1) * 255).round().astype(np.uint8)
    coding = coding or ("-c:v", "libx264", "-qp", "1", "-pix_fmt", "yuv444p")
    shape = f"{clip.shape[2]}x{clip.shape[1]}"
    command = ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", shape, "-r", str(fps), "-i", "-"]
    subprocess.run([*command, *map(str, coding), str(path)], input=frames.tobytes(), check=True, timeout=60)
    return path
