"""Small clips, made here: a texture that passes by, as raw video that FFmpeg knows by its first line."""

from pathlib import Path

import numpy as np

SIZE, FRAMES, FPS, STEP = (96, 64), 24, 25, 2  # px, frames, 1/s, px/frame to the right
RGB_TO_YUV = np.array([[65.481, 128.553, 24.966], [-37.797, -74.203, 112], [112, -93.786, -18.214]])


def passing(size=SIZE, frames=FRAMES, step=STEP, seed=1) -> np.ndarray:
    """frames x height x width x 3, 0 .. 1: smooth noise."""
    whole = np.random.default_rng(seed).random((size[1], size[0] + step * frames, 3))
    for axis in (0, 1):
        whole = sum(np.roll(whole, shift, axis) * weight for shift, weight in zip(range(-3, 4), (1, 6, 15, 20, 15, 6, 1), strict=True))
    return scrolled((whole - whole.min()) / np.ptp(whole), size, frames, step)


def scrolled(whole: np.ndarray, size=SIZE, frames=FRAMES, step=STEP) -> np.ndarray:
    """A picture that is wide enough, height x width x 3, passing by."""
    width, height = size
    starts = [step * (frames - i) for i in range(frames)]
    return np.stack([whole[:height, start : start + width] for start in starts])


def write(path: Path, pixels: np.ndarray | None = None, fps: int = FPS) -> Path:
    """Writes a clip under any name; Blender takes it for a movie where that ends as one."""
    pixels = passing() if pixels is None else pixels
    _, height, width, _ = pixels.shape
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "wb") as file:
        file.write(f"YUV4MPEG2 W{width} H{height} F{fps}:1 Ip A1:1 C444\n".encode())
        for frame in pixels:
            yuv = np.rint(frame @ RGB_TO_YUV.T + (16, 128, 128)).clip(0, 255).astype(np.uint8)
            file.write(b"FRAME\n" + np.ascontiguousarray(np.moveaxis(yuv, 2, 0)).tobytes())
    return path
