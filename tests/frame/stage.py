"""A small picture with all motions, for the tests of this room."""

import numpy as np
from stillwater import _stillwater as engine

WIDTH, HEIGHT = 96, 64
HORIZON = ((0.0, 24.0), (96.0, 24.0))
NONE = engine.Fill.none
PUSH_PULL = engine.Fill.push_pull


def picture(seed=5, width=WIDTH, height=HEIGHT):
    """Noise of 8 bit levels."""
    levels = np.random.default_rng(seed).integers(0, 256, (height, width, 3)) / 255
    return np.concatenate([levels, np.ones((height, width, 1))], axis=2).astype(np.float32)


def smooth_picture(width=WIDTH, height=HEIGHT):
    """Slow waves of colour: can be resampled with little loss."""
    y, x = np.mgrid[:height, :width]
    waves = [0.5 + 0.3 * np.sin(x / a + y / b + c) for a, b, c in ((9, 13, 0), (11, -8, 1), (-14, 10, 2))]
    return np.stack([*waves, np.ones_like(waves[0])], axis=2).astype(np.float32)


def matte(top, bottom, left, right, width=WIDTH, height=HEIGHT):
    area = np.zeros((height, width), np.float32)
    area[top:bottom, left:right] = 1
    return area


TREE, BOAT, REFLECTION, CLOUDS, SEA = (
    matte(4, 50, 8, 28), matte(34, 46, 44, 64), matte(46, 56, 44, 64), matte(0, 20, 0, 96), matte(26, 64, 0, 96)
)
MATTES = [TREE, BOAT, REFLECTION, CLOUDS, SEA, None]
MOTIONS = [
    engine.Sway(armature=((18, 50), (18, 4)), amount=2.0, seed=1),
    engine.Bob(waterline=[(44, 46), (64, 46)], amount=2.0),
    None,
    engine.Drift(),
    engine.Ripple(amplitude=0.6, resolution=64, seed=2),
    None,
]
TIES = [{}, {"water": 4}, {"follows": 1, "mirror": True}, {"endless": (True, False)}, {}, {}]


class Stage:
    """The picture, cut and ready: `frame(t)` renders it."""

    def __init__(self, image=None, mattes=MATTES, motions=MOTIONS, ties=TIES, scale=1.0, speed=8.0, loop=0, velocity=(0.8, 0.0),
                 fill=PUSH_PULL, alpha=None, direction=0.0, gusts=0.0):
        self.image = picture() if image is None else image
        self.motions, self.loop, self.speed, self.velocity, self.direction, self.gusts = motions, loop, speed, velocity, direction, gusts
        height, width = self.image.shape[:2]
        cut = self._peel(self.image, mattes, fill)
        layers = [engine.Layer(layer, motion=motion, **tie) for layer, motion, tie in zip(cut, motions, ties, strict=True)]
        grey = None
        if alpha is not None:
            grey = self._peel(np.dstack([alpha] * 3 + [np.ones_like(alpha)]).astype(np.float32), mattes, fill)
        view = engine.View(horizon=HORIZON)
        self.renderer = engine.FrameRenderer((width, height), scale, view, self._wind(1), layers, grey)

    @staticmethod
    def _peel(image, mattes, fill):
        return engine.peel(image, mattes, [fill] * len(mattes), [0.0] * len(mattes))

    def _wind(self, frame):
        travel = self.speed * (frame - 1) / 24
        angle = np.radians(self.direction)
        return engine.Wind(speed=self.speed, direction=self.direction, gusts=self.gusts,
                           travel=(travel * np.cos(angle), travel * np.sin(angle)))

    def moment(self, frame):
        angle, gained = np.radians(self.direction), self.speed * self.loop / 24
        return engine.Moment(frame=frame, fps=24, first_frame=1, loop_frames=self.loop, wind=self._wind(frame),
                             loop_travel=(gained * np.cos(angle), gained * np.sin(angle)))

    def states(self, frame):
        offset = tuple(v * (frame - 1) for v in self.velocity)
        drift = engine.Drift(offset=offset, loop_offset=tuple(v * self.loop for v in self.velocity))
        return [engine.LayerState(1.0, drift if isinstance(m, engine.Drift) else m) for m in self.motions]

    def frame(self, frame, **wish):
        return self.renderer.render(self.moment(frame), self.moment(frame + 1), self.states(frame), self.states(frame + 1), **wish)
