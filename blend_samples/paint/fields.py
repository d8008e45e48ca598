"""Smooth fields over a picture: blur, noise, and the direction in which its forms run."""

import numpy as np


def blur(field: np.ndarray, sigma: float) -> np.ndarray:
    """Gaussian blur of (H, W) or (H, W, C) with the border held; sigma in pixels."""
    if sigma <= 0.05:
        return field
    planes = field if field.ndim == 3 else field[..., None]
    pad = int(np.ceil(3 * sigma))
    padded = np.pad(planes, ((pad, pad), (pad, pad), (0, 0)), mode="edge")
    fy = np.fft.fftfreq(padded.shape[0])[:, None]
    fx = np.fft.rfftfreq(padded.shape[1])[None, :]
    gain = np.exp(-2 * (np.pi * sigma) ** 2 * (fy * fy + fx * fx))
    out = np.empty_like(planes, dtype=np.float32)
    for c in range(planes.shape[2]):
        smooth = np.fft.irfft2(np.fft.rfft2(padded[..., c]) * gain, padded.shape[:2])
        out[..., c] = smooth[pad:-pad, pad:-pad]
    return out if field.ndim == 3 else out[..., 0]


def noise(shape: tuple[int, int], scale: float, rng: np.random.Generator, octaves: int = 4) -> np.ndarray:
    """Noise of mean 0 and variance 1 with features of `scale` pixels and finer ones."""
    total = np.zeros(shape, np.float32)
    for k in range(octaves):
        layer = blur(rng.standard_normal(shape).astype(np.float32), max(scale / 2 / 2**k, 0.4))
        total += layer / layer.std() * 0.55**k
    return (total - total.mean()) / total.std()


def direction(lightness: np.ndarray, sigma: float, fallback: np.ndarray) -> np.ndarray:
    """Angle (radians, clockwise from right) along the forms, by the structure tensor smoothed over `sigma` px.

    Where the picture has no direction of its own, the angle goes over to `fallback` (H, W).
    """
    gy, gx = np.gradient(blur(lightness, 1.0))
    cos2 = blur(gx * gx - gy * gy, sigma)
    sin2 = blur(2 * gx * gy, sigma)
    energy = blur(gx * gx + gy * gy, sigma)
    weak = 0.15 * energy.mean() + 1e-9
    # The tensor's major axis crosses the form; a right angle more (pi in the doubled angle) runs along it.
    x = -cos2 / (energy + weak) + 0.6 * weak / (energy + weak) * np.cos(2 * fallback)
    y = -sin2 / (energy + weak) + 0.6 * weak / (energy + weak) * np.sin(2 * fallback)
    return 0.5 * np.arctan2(y, x)


def rippled(image: np.ndarray, horizon: np.ndarray, sway: float, length: float, rng: np.random.Generator) -> np.ndarray:
    """A mirror image broken up by waves: rows pushed to and fro by up to `sway` px at the lower border.

    horizon: its y (px) for each column (W,); length: a wave's height in px at the lower border. Both shrink
    towards the horizon, as the water's distance grows.
    """
    h, w = image.shape[:2]
    y, x = np.mgrid[0:h, 0:w].astype(np.float32)
    near = np.clip((y - horizon[None, :]) / max(h - float(horizon.mean()), 1), 0.003, 1)
    depth = 1 / near
    push = np.zeros((h, w), np.float32)
    for k in range(10):
        turns = 2.0 * np.pi * rng.uniform(0.6, 2.6) * h / (length * 14)
        slant = rng.uniform(-9, 9) / w
        push += np.sin(turns * depth + slant * x * depth * 0.4 + rng.uniform(0, 2 * np.pi)) / np.sqrt(10)
    at = np.clip(x + push * sway * near, 0, w - 1.001)
    left = np.floor(at).astype(int)
    share = (at - left)[..., None]
    rows = np.arange(h)[:, None]
    return image[rows, left] * (1 - share) + image[rows, left + 1] * share


def twice(image: np.ndarray) -> np.ndarray:
    """The image enlarged: what the painter looks at is blurred by his brush, so half the pixels do."""
    for axis in (0, 1):
        last = image.shape[axis] - 1
        at = np.arange(2 * (last + 1)) / 2 - 0.25
        low = np.clip(np.floor(at).astype(int), 0, last)
        share = np.expand_dims(np.clip(at - low, 0, 1).astype(np.float32), [1 - axis, 2])
        image = image.take(low, axis) * (1 - share) + image.take(np.minimum(low + 1, last), axis) * share
    return image
