"""What the renderer refuses of a layer that flows."""

import numpy as np
import pytest
from stage import picture
from stillwater import _stillwater as engine


def rendered(flow, fields=None, longest=4.0, **tie):
    image = engine.LayerImage(picture(), (0, 0, 96, 64))
    fields = [np.ones((64, 96, 2), np.float32)] if fields is None else fields
    plates = engine.make_plates(image, None, (96, 64), 1.0, None, [], fields, longest)
    layers = [engine.Layer(plates, engine.Flow(), **tie), engine.Layer(image)]
    renderer = engine.FrameRenderer((96, 64), 1.0, engine.View(), engine.Wind(), layers)
    states = [engine.LayerState(motion=flow), engine.LayerState()]
    return renderer.render(engine.Moment(), engine.Moment(), states, states)


def test_without_ways_it_is_the_picture():
    assert np.array_equal(rendered(engine.Flow(cycle=0.3)).combined, picture())


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda: rendered(engine.Flow(cycle=2)), "flow.cycle: 2 is not between 0 and 1"),
        (lambda: rendered(engine.Flow(ways=[1])), "flow.ways: 1 is not 2 or more"),
        (lambda: rendered(engine.Flow(field=1)), "flow.field: 1 is not the index of one of 1 fields"),
        (lambda: rendered(engine.Flow(), []), r"layers\[0\].plates: made without a flow"),
        (lambda: rendered(engine.Flow(), [np.ones((4, 4, 2))]), "flow: a field that does not fit the layer's box"),
        (lambda: rendered(engine.Flow(), longest=-1), "longest: -1 is not between 0 and 1e\\+12"),
        (lambda: rendered(engine.Flow(), follows=1), r"layers\[0\].follows: a flow neither follows nor is followed"),
    ],
)
def test_what_is_refused(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call()
