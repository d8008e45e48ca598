"""Flow from 30 strokes against the figure that live painting needs, and against scipy's interpolation of the same points."""

from __future__ import annotations

import numpy as np
from bench import Row, medians

SIZE = (1280, 720)
STROKES = 30


def strokes() -> list[dict]:
    """As an artist draws along a stream with two whirls: 270 px each, a trembling pen, some lie over others."""
    rng = np.random.default_rng(1)

    def stream(x, y):
        flow = np.array([1.0, 0.25 * np.sin(x / 180)])
        for middle, turn in (((400, 250), 1), ((900, 480), -1)):
            out = np.array([x, y]) - middle
            flow = flow + turn * np.array([-out[1], out[0]]) / 75 * np.exp(-(out @ out) / 120**2)
        return flow

    drawn = []
    for _ in range(STROKES):
        at, points = rng.uniform([20, 20], np.array(SIZE) - 20), []
        for _ in range(45):
            flow = stream(*at)
            points.append((at + rng.normal(0, 0.5, 2)).tolist())
            at = at + 6 * flow / np.hypot(*flow)
        drawn.append({"points": points, "speed": float(2 * np.hypot(*flow)), "width": 12})
    return drawn


def rows():
    from scipy.interpolate import RBFInterpolator
    from stillwater import _stillwater as engine
    from stillwater.flow_painting import _flow_strokes

    drawn = strokes()
    given = _flow_strokes(drawn)
    picture = np.random.default_rng(2).random((SIZE[1], SIZE[0], 4), np.float32)
    picture[..., 3] = 1
    painted = engine.paint_flow(given, SIZE)
    flow = engine.refine_flow(painted, picture)
    matte = np.ones((SIZE[1], SIZE[0]), np.float32)
    matte[300:400, 500:700] = 0

    whole, paint, bounded, refine, streaks, propose = medians(
        lambda: engine.refine_flow(engine.paint_flow(given, SIZE), picture),
        lambda: engine.paint_flow(given, SIZE),
        lambda: engine.paint_flow(given, SIZE, matte, 1 - matte),
        lambda: engine.refine_flow(painted, picture),
        lambda: engine.Streaks(flow).at(0.3),
        lambda: engine.propose_flow(picture, "water"),
    )
    made = engine.Streaks(flow)
    (phase,) = medians(lambda: made.at(0.3, (640, 360)))
    yield Row("flow from 30 strokes, refined, 1280x720", whole * 1e3, 60, 1, note=f"painted in {paint * 1e3:.0f}, refined in {refine * 1e3:.0f}")
    yield Row("flow from 30 strokes with bound and freeze, 1280x720", bounded * 1e3, 60, 1)
    yield Row("streaks 1280x720", streaks * 1e3, 50, 1, note=f"another phase at half size {phase * 1e3:.1f}")
    yield Row("flow proposed by a picture 1280x720", propose * 1e3, 200, 1)

    places, values = map(np.array, engine.stroke_pixels(given, SIZE, True))
    some = np.stack(np.meshgrid(np.arange(0, SIZE[0], 4), np.arange(0, SIZE[1], 4)), axis=2).reshape(-1, 2)
    (theirs,) = medians(lambda: RBFInterpolator(places, values, kernel="linear")(some + 0.5), runs=1, warmup=0)
    exact = RBFInterpolator(places, values, kernel="linear")(some + 0.5)
    exact /= np.linalg.norm(exact, axis=1, keepdims=True)
    turned = np.degrees(np.arccos(np.clip((painted.orientation[some[:, 1], some[:, 0]] * exact).sum(axis=1), -1, 1)))
    note = f"{len(places)} points; scipy at every 16th pixel"
    yield Row("orientation and speed from 30 strokes (scipy: orientation)", paint * 1e3, theirs * 1e3, 1 / 10, note=note)
    yield Row("directions of 30 strokes off the dense solve, mean", turned.mean(), 1, 1, unit="deg")
    yield Row("directions of 30 strokes off the dense solve, 99 %", np.percentile(turned, 99), 4, 1, unit="deg")
