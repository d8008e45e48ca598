"""How far a matte is from the true one: the four figures of alphamatting.com, over the unknown pixels."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
import scipy.ndimage
import scipy.signal


@dataclass(frozen=True)
class Errors:
    """Sums over pixels; `sad`, `gradient` and `connectivity` in thousands."""

    sad: float
    mse: float
    gradient: float
    connectivity: float

    def __add__(self, other: Errors) -> Errors:
        return Errors(*(getattr(self, field.name) + getattr(other, field.name) for field in fields(self)))


def errors(matte: np.ndarray, truth: np.ndarray, unknown: np.ndarray) -> Errors:
    """`matte` and `truth` 0..1, `unknown` a mask; height x width each."""
    off = np.abs(matte - truth)[unknown]
    return Errors(
        float(off.sum() / 1000),
        float((off**2).mean()),
        float(((_gradient(matte) - _gradient(truth)) ** 2)[unknown].sum() / 1000),
        float(_disconnected(matte, truth)[unknown].sum() / 1000),
    )


def _gradient(matte: np.ndarray, sigma: float = 1.4) -> np.ndarray:
    """The gradient's magnitude, by first-order Gaussian derivatives (Rhemann et al. 2009, 3.1)."""
    reach = int(np.ceil(3 * sigma))
    x = np.arange(-reach, reach + 1)
    bell = np.exp(-(x**2) / (2 * sigma**2))
    slope = -x * bell
    kernel = np.outer(bell, slope)
    kernel /= np.sqrt((kernel**2).sum())
    padded = np.pad(matte, reach, mode="edge")
    across, down = (scipy.signal.fftconvolve(padded, k, mode="valid") for k in (kernel, kernel.T))
    return np.hypot(across, down)


def _disconnected(matte: np.ndarray, truth: np.ndarray, step: float = 0.1) -> np.ndarray:
    """How differently pixels hang together with what is wholly foreground in both (Rhemann et al. 2009, 3.2)."""
    level = np.full(matte.shape, -1.0)  # up to which a pixel is connected to the largest solid region of both
    thresholds = np.arange(0, 1 + step / 2, step)
    for below, threshold in zip(thresholds, thresholds[1:], strict=False):
        regions, count = scipy.ndimage.label((matte >= threshold) & (truth >= threshold))
        largest = np.bincount(regions.ravel())[1:].argmax() + 1 if count else -1
        level[(level < 0) & (regions != largest)] = below
    level[level < 0] = 1

    def degree(alpha: np.ndarray) -> np.ndarray:
        off = alpha - level
        return 1 - off * (off >= 0.15)

    return np.abs(degree(matte) - degree(truth))
