"""How alike two films of a fluid are, as a viewer may tell: by their rhythm, their speed and their texture.

Films are frames x height x width, luma; a mask says which pixels count.
"""

import numpy as np
import stillwater

OCTAVES = 4
CELL = 55  # px: about that of the histogram matching's grid


def spectrum(film: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Mean power of the pixels' changes in time, octave by octave from the fastest down, as many as the film is long for, in
    dB."""
    series = film[:, mask] - film[:, mask].mean(axis=0)
    window = np.hanning(len(series))[:, None]
    power = (np.abs(np.fft.rfft(series * window, axis=0)) ** 2).mean(axis=1)
    top, octaves = len(power), []
    for _ in range(OCTAVES):
        low = top // 2
        if max(low, 1) >= top:
            break
        octaves.append(power[max(low, 1) : top].mean())
        top = low
    return 10 * np.log10(np.maximum(octaves, 1e-12))


def spectrum_off(film, real, mask) -> float:
    """The largest difference of an octave, dB."""
    return float(np.abs(spectrum(film, mask) - spectrum(real, mask)).max())


def speeds(film: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """How fast what is seen moves, px/frame, of every fourth pair of frames."""
    pairs = range(0, len(film) - 1, 4)
    return np.concatenate([np.hypot(*np.moveaxis(stillwater.optical_flow(film[i], film[i + 1]), -1, 0))[mask] for i in pairs])


def apart(a: np.ndarray, b: np.ndarray) -> float:
    """How far two sets of numbers must be moved to be one another, on the mean (earth mover's distance)."""
    ranks = np.linspace(0, 1, 401)
    return float(np.abs(np.quantile(a, ranks) - np.quantile(b, ranks)).mean())


def speeds_off(film, real, mask) -> float:
    """Distance of the histograms of speed, px/frame."""
    return apart(speeds(film, mask), speeds(real, mask))


def bands_off(film, real, mask) -> float:
    """Distance of the histograms of a steerable pyramid's bands, of the real film's own deviation, their mean."""
    found = []
    for frames in (film, real):
        pyramids = [stillwater.steerable_pyramid(frames[i], scales=3, orientations=4) for i in range(0, len(frames), 8)]
        found.append(pyramids)
    off = []
    for band in range(len(_bands(found[0][0]))):
        ours, theirs = (np.concatenate([_inside(_bands(pyramid)[band], mask) for pyramid in pyramids]) for pyramids in found)
        off.append(apart(ours, theirs) / max(theirs.std(), 1e-6))
    return float(np.mean(off))


def stuck(film: np.ndarray, mask: np.ndarray) -> float:
    """How much of the finest detail stays at its place: correlation of frames that are 8 or more apart."""
    fine = np.array([frame - _blurred(frame) for frame in film])[:, mask]
    fine -= fine.mean(axis=1, keepdims=True)
    pairs = [(i, i + gap) for gap in (8, 16) for i in range(0, len(film) - gap, 4)]
    norms = np.linalg.norm(fine, axis=1)
    return float(np.mean([fine[i] @ fine[j] / max(norms[i] * norms[j], 1e-9) for i, j in pairs]))


def grid(film: np.ndarray, picture: np.ndarray, mask: np.ndarray) -> float:
    """How much neighbouring cells differ in their means and deviations, of how much the picture's own do: above 1 a grid
    shows."""
    return float(np.mean([_unlike(frame, mask) for frame in film[::8]]) / max(_unlike(picture, mask), 1e-9))


def flicker(film: np.ndarray, real: np.ndarray, mask: np.ndarray) -> float:
    """How much the cells' means change from frame to frame, of how much those of the real film do."""
    ours, theirs = (np.array([_cells(frame, mask)[0] for frame in frames]) for frames in (film, real))
    return float(np.nanmean(np.abs(np.diff(ours, axis=0))) / max(np.nanmean(np.abs(np.diff(theirs, axis=0))), 1e-9))


def _unlike(frame: np.ndarray, mask: np.ndarray) -> float:
    differences = [np.diff(statistic, axis=axis).ravel() for statistic in _cells(frame, mask) for axis in (0, 1)]
    return float(np.nanmean(np.abs(np.concatenate(differences))))


def _cells(frame: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Mean and deviation of each cell of which the mask holds half or more, 2 x rows x columns; else NaN."""
    rows, columns = (max(1, round(side / CELL)) for side in frame.shape)
    found = np.full((2, rows, columns), np.nan)
    for i, (band, seen) in enumerate(zip(np.array_split(frame, rows), np.array_split(mask, rows), strict=True)):
        for j, (cell, inside) in enumerate(zip(np.array_split(band, columns, 1), np.array_split(seen, columns, 1), strict=True)):
            if inside.mean() >= 0.5:
                found[:, i, j] = cell[inside].mean(), cell[inside].std()
    return found


def _blurred(frame):
    from scipy.ndimage import gaussian_filter

    return gaussian_filter(frame, 2)


def _bands(pyramid) -> list:
    return [pyramid.highpass, *[band for scale in pyramid.bands for band in scale]]


def _inside(band: np.ndarray, mask: np.ndarray) -> np.ndarray:
    rows = np.arange(band.shape[0]) * mask.shape[0] // band.shape[0]
    columns = np.arange(band.shape[1]) * mask.shape[1] // band.shape[1]
    return band[mask[np.ix_(rows, columns)]]
