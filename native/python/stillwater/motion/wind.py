"""The one wind of a picture."""

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _stillwater as engine

Place = tuple[float, float]  # (x, y), picture pixels
Size = tuple[int, int]  # (width, height), pixels


@dataclass(frozen=True)
class Wind:
    """A steady wind over the ground, with its turbulence and, if wanted, gusts that travel over the picture.

    speed: mean, m/s, 0 .. 40.
    direction: degrees, where it blows to over the ground: 0 = the picture's right, 90 = away from the viewer.
    gusts: 0 .. 1, share of the speed that comes as moving gusts.
    gust_size: of the picture's width, above 0. The picture's width stands for 50 m.
    seed: of the gusts; what a layer gets of the turbulence follows the layer's own seed.

    Raises BadInput (a ValueError) where a number is outside its range.
    Source: Chuang et al. 2005, 3.2 (turbulence); the gusts are our own law (motion/gusts.h).
    """

    speed: float = 5
    direction: float = 0
    gusts: float = 0
    gust_size: float = 0.25
    seed: int = 0

    def __post_init__(self):
        self.moment(1)

    def series(
        self, seconds: ArrayLike, *, seed: int = 0, loop_seconds: float | None = None
    ) -> NDArray[np.float64]:
        """Turbulence at one element: deviation of the wind from its mean along its heading, m/s, float64.

        seconds: times, a number or an array; the result has its shape.
        seed: of the element.
        loop_seconds: period; the series closes after it. None: 128 s.

        The one-sided power spectrum is P_V(f) = c v / (1 + 500 m f / v)^(5/3), whose whole integral is the square of
        0.17 v; the series has its part from one turn a period to 8 Hz. Raises BadInput (a ValueError).
        Source: Chuang et al. 2005, eq. 8 and 9; METHODS.md 1.
        """
        noise = engine.TurbulenceNoise(seed)
        seconds = np.asarray(seconds, np.float64)
        # A frame rate that makes the loop one frame long: frames are then the loop's whole and broken turns.
        fps, loop = (1.0, None) if loop_seconds is None else (1 / loop_seconds, 1)
        values = [engine.turbulence(noise, self.moment(1 + t * fps, fps, loop)) for t in seconds.flat]
        return np.array(values).reshape(seconds.shape)

    def gust(self, place: Place, size: Size, frame: float, *, fps: float = 24, loop: int | None = None) -> float:
        """Local over mean wind speed: never negative, 1 on the whole, 1 everywhere where `gusts` is 0.

        place: (x, y), picture pixels. size: (width, height) of the picture, pixels. frame: may be fractional.
        loop: period in frames, None = no loop.
        """
        field = engine.GustField(self.gust_size, self.seed, size)
        return field.factor(place, self.moment(frame, fps, loop))

    def moment(self, frame: float, fps: float = 24, loop: int | None = None) -> engine.Moment:
        """The engine's numbers of one frame under this wind."""
        velocity = (self.speed * cos(radians(self.direction)), self.speed * sin(radians(self.direction)))
        wind = engine.Wind(
            speed=self.speed,
            direction=self.direction,
            gusts=self.gusts,
            gust_size=self.gust_size,
            seed=self.seed,
            travel=tuple(v * (frame - 1) / fps for v in velocity),
        )
        loop_travel = tuple(v * (loop or 0) / fps for v in velocity)
        moment = engine.Moment(frame=frame, fps=fps, loop_frames=loop or 0, wind=wind, loop_travel=loop_travel)
        engine.check_moment(moment)
        return moment
