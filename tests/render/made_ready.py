"""Recipes made ready for any frame, and their frames compared."""

from types import SimpleNamespace

import numpy as np
from stillwater import _stillwater as engine
from stillwater import load
from stillwater.render.loop import Job, Order


def made_ready(path, **order):
    """The renderer, and the events on the way."""
    job = Job(load(path), Order(**order))
    list(job.check_files())
    steps, events = job.ready(SimpleNamespace(beat=lambda: None)), []
    while True:
        try:
            events.append(next(steps))
        except StopIteration as done:
            return done.value, events


def renderer(path, **order):
    return made_ready(path, **order)[0]


def same(a, b):
    return all(np.array_equal(x, y) for x, y in ((a.combined, b.combined), (a.flow, b.flow), (a.matte, b.matte)))


def picture(path):
    return engine.read_picture(str(path.parent / "picture.png")).image
