"""Figures of a filled hole that need no truth: is it made of what the picture is made of, and not of one thing only?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, uniform_filter

PATCH = 7  # pixels a side
NEIGHBOURHOOD = 32  # pixels a side
DIMENSIONS = 32  # in which patches are searched
MOST_WANTED = 1500  # patches of the hole, evenly chosen

Picture = NDArray[np.float32]  # height x width x 3, 0 .. 1
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Figures:
    """Of one filled hole; less is better.

    coherence: mean distance of the patches that touch the hole to the most alike one outside (RMS, in levels of 255).
    repetition: the largest share of those patches whose most alike ones lie in one neighbourhood.
    error: RMS difference to the truth, where there is one.
    """

    coherence: float
    repetition: float
    error: float


def figures_of(filled: Picture, hole: Mask, truth: Picture | None = None) -> Figures:
    """The figures of `filled`, rounded to 8 bits as files are."""
    filled = (np.clip(filled, 0, 1) * 255 + 0.5).astype(np.uint8).astype(np.float32)
    apart, places = _most_alike(filled, hole)
    shares = np.zeros(hole.shape)
    np.add.at(shares, tuple(places.T), 1 / len(places))
    repetition = uniform_filter(shares, NEIGHBOURHOOD, mode="constant").max() * NEIGHBOURHOOD**2
    error = np.nan if truth is None else float(np.sqrt(np.mean((filled / 255 - truth)[hole] ** 2)))
    return Figures(float(apart.mean()), float(repetition), error)


def _most_alike(filled: Picture, hole: Mask) -> tuple[NDArray, NDArray]:
    """For each patch that touches the hole the distance to the most alike one outside, and where that is."""
    half = PATCH // 2
    touching = binary_dilation(hole, np.ones((PATCH, PATCH)))[half:-half, half:-half]
    windows = np.lib.stride_tricks.sliding_window_view(filled, (PATCH, PATCH), (0, 1))
    wanted, known = np.argwhere(touching), np.argwhere(~touching)
    wanted = wanted[np.unique(np.linspace(0, len(wanted) - 1, MOST_WANTED).astype(int))]
    sources, targets = (windows[places[:, 0], places[:, 1]].reshape(len(places), -1) for places in (known, wanted))
    mean = sources.mean(axis=0)
    axes = np.linalg.svd(sources[:: len(sources) // 3000 + 1] - mean, full_matrices=False)[2][:DIMENSIONS].T
    short, wanted_short = (sources - mean) @ axes, (targets - mean) @ axes
    lengths = (short**2).sum(axis=1)
    best = np.concatenate([(lengths - 2 * some @ short.T).argmin(axis=1) for some in np.array_split(wanted_short, 20)])
    return np.sqrt(np.mean((sources[best] - targets) ** 2, axis=1)), known[best] + half
