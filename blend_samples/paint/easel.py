"""One picture's easel: its size, its random numbers, and painting a layer as the scenes ask for it."""

import numpy as np

from .fields import noise, rippled
from .layers import crisp
from .strokes import brushwork, light_relief, paint


class Easel:
    """Lengths are given for a picture 1280 px wide and brought to this one's width."""

    def __init__(self, width: int, height: int, seed: int) -> None:
        self.width, self.height, self.scale = width, height, width / 1280
        self.rng = np.random.default_rng(seed)

    def wander(self, mean: float, swing: float, size: float) -> np.ndarray:
        """Angles (H, W), radians, that stray from `mean` by `swing` over places of `size` px."""
        return swing * noise((self.height, self.width), size * self.scale, self.rng) + mean

    def paint(self, guide: np.ndarray, rounds: list, angle, follow: float, relief: float,
              sharp: bool = False) -> np.ndarray:
        """Paints a layer (premultiplied display RGBA) in `rounds` (see strokes.brushwork) and lights its ridges.

        angle, follow: see strokes.paint; sharp: its coverage becomes whole but for an edge.
        """
        work = brushwork(self.scale, *rounds)
        layer = light_relief(paint(guide, work, self.rng, angle, follow * self.scale), relief)
        return crisp(layer) if sharp else layer

    def mirror(self, image: np.ndarray, horizon: list, sway: float, wave: float, dim: float, tint: tuple,
               cover: float) -> np.ndarray:
        """A mirror image as water shows it: broken by waves (see fields.rippled), darker, tinted, `cover` opaque."""
        across = np.arange(self.width) + 0.5
        row = np.interp(across, [end[0] for end in horizon], [end[1] for end in horizon])
        broken = rippled(image, row, sway * self.scale, wave * self.scale, self.rng)
        broken[..., :3] = broken[..., :3] * dim + broken[..., 3:] * np.array(tint, np.float32)
        below = np.arange(self.height)[:, None, None] > row[None, :, None] + 1
        return broken * np.where(below, cover, 0.0)
