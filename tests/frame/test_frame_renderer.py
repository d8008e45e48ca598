"""A whole frame: the picture at rest, any frame alone, any number of threads, loops, alpha, scale, layers of their own."""

import numpy as np
import pytest
from stage import BOAT, MATTES, MOTIONS, NONE, SEA, TIES, TREE, Stage, matte, picture, smooth_picture
from stillwater import _stillwater as engine


def same(a, b):
    return all(np.array_equal(x, y) for x, y in ((a.combined, b.combined), (a.flow, b.flow), (a.matte, b.matte)))


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)


def test_at_rest_the_picture_comes_back_bit_by_bit():
    stage = Stage(speed=0.0, velocity=(0, 0))
    frame = stage.frame(40)
    assert np.array_equal(frame.combined, stage.image)
    assert not frame.flow.any()


def test_every_layer_moves():
    stage = Stage()
    moved = np.abs(stage.frame(30).combined - stage.image)[..., :3].max(axis=2)
    for area in (TREE, BOAT, MATTES[3], SEA):
        assert (moved[area == 1] > 0.05).mean() > 0.3
    assert not moved[20:24, 60:].any()


def test_any_frame_alone_and_in_any_order():
    stage = Stage(gusts=0.5)
    forwards = [stage.frame(t) for t in (3, 4, 5)]
    assert same(stage.frame(4), forwards[1])
    assert same(Stage(gusts=0.5).frame(5), forwards[2])


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_any_number_of_threads(threads):
    expected = Stage(gusts=0.5).frame(17)
    engine.set_threads(threads)
    assert same(Stage(gusts=0.5).frame(17), expected)


@pytest.mark.parametrize("velocity", [(0.8, 0.0), (120 / 32, 0.0)], ids=["cross-fade", "whole turn"])
def test_a_loop_closes_to_the_byte(velocity):
    stage = Stage(loop=32, velocity=velocity, gusts=0.5)
    assert same(stage.frame(5), stage.frame(5 + 32))
    assert not same(stage.frame(5), stage.frame(6))


def test_a_loop_has_no_seam():
    stage = Stage(image=smooth_picture(), loop=32, gusts=0.5)
    steps = [np.abs(stage.frame(t).combined - stage.frame(t + 1).combined).mean() for t in range(1, 34)]
    assert steps[31] < 2 * np.median(steps)


def test_the_loops_first_frame_has_the_clouds_where_they_were_painted():
    stage = Stage(loop=32, speed=0.0)
    clouds = stage.frame(1).combined[:20, 30:]
    assert np.allclose(clouds, stage.image[:20, 30:], atol=1e-6)


def test_a_cloud_that_cross_fades_gets_neither_brighter_nor_an_outline():
    cloud = matte(8, 20, 30, 60)
    image = np.ones((*cloud.shape, 4), np.float32)
    image[..., :3] = np.where(cloud > 0, 0.9, 0.2)[..., None]
    stage = Stage(image=image, mattes=[cloud, None], motions=[engine.Drift(), None], ties=[{"endless": (True, False)}, {}], loop=32)
    for t in (9, 17, 25):
        shown = stage.frame(t).combined[..., :3]
        assert 0.19 < shown.min() and shown.max() < 0.91


def test_numbers_are_numbers():
    for t in (-500, 1, 7, 100_000):
        frame = Stage(gusts=1.0, direction=200.0).frame(t)
        assert np.isfinite(frame.combined).all() and np.isfinite(frame.flow).all() and np.isfinite(frame.matte).all()
        assert frame.combined[..., 3].min() > 1 - 1e-3 and frame.combined[..., 3].max() <= 1.0001


def test_matte_is_the_share_of_what_moves():
    frame = Stage(speed=0.0, velocity=(0, 0)).frame(1)
    moving = np.maximum.reduce([TREE, BOAT, MATTES[2], MATTES[3], SEA])
    assert np.array_equal(frame.matte, moving)


def test_a_hidden_layer_shows_its_fill():
    image = np.ones_like(picture()) * np.float32([0.5, 0.6, 0.7, 1])
    image[TREE == 1] = (0, 0, 0, 1)
    cut = engine.peel(image, [TREE, None], [engine.Fill.push_pull] * 2, [0.0] * 2)
    layers = [engine.Layer(cut[0], visible=False), engine.Layer(cut[1])]
    renderer = engine.FrameRenderer((96, 64), 1.0, engine.View(), engine.Wind(), layers)
    states = [engine.LayerState(), engine.LayerState()]
    shown = renderer.render(engine.Moment(), engine.Moment(), states, states).combined
    assert np.allclose(shown, (0.5, 0.6, 0.7, 1), atol=1e-4)


def test_opacity_thins_a_layer():
    def shown(opacity):
        cut = engine.peel(picture(), [TREE, None], [engine.Fill.push_pull] * 2, [0.0] * 2)
        renderer = engine.FrameRenderer((96, 64), 1.0, engine.View(), engine.Wind(), [engine.Layer(layer) for layer in cut])
        states = [engine.LayerState(opacity=opacity), engine.LayerState()]
        return renderer.render(engine.Moment(), engine.Moment(), states, states).combined

    assert np.allclose(shown(0.3), 0.3 * shown(1.0) + 0.7 * shown(0.0), atol=1e-6)


def test_nothing_behind_is_transparent():
    stage = Stage(mattes=[TREE, None], motions=[MOTIONS[0], None], ties=[{}, {}], fill=NONE)
    alpha = stage.frame(30).combined[..., 3]
    assert alpha.min() < 0.1 and (alpha[TREE == 0] > 0.9).all()


def test_the_pictures_own_alpha_moves_with_it():
    alpha = np.ones((64, 96), np.float32)
    alpha[:, 60:] = 0.25
    image = picture()
    image[..., :3] *= alpha[..., None]
    rest = Stage(image=image, alpha=alpha, speed=0.0, velocity=(0, 0)).frame(1).combined
    assert np.array_equal(rest[..., 3], alpha) and np.array_equal(rest[..., :3], image[..., :3])
    drifted = Stage(image=image, alpha=alpha, mattes=[MATTES[3], None], motions=[engine.Drift(), None], ties=[TIES[3], {}],
                    velocity=(1.0, 0.0)).frame(11).combined
    assert np.allclose(drifted[:16, 24:68, 3], 1, atol=1e-6)


@pytest.mark.parametrize("scale, size", [(0.5, (48, 32)), (2.0, (192, 128)), (0.37, (36, 24)), (0.001, (1, 1))])
def test_another_scale_shows_the_same(scale, size):
    stage = Stage(image=smooth_picture(), scale=scale)
    assert stage.renderer.size == size
    small = stage.frame(20).combined
    assert small.shape[:2] == size[::-1]
    if min(size) > 1:
        whole = Stage(image=smooth_picture()).frame(20).combined
        x = np.clip((np.arange(size[0]) + 0.5) / scale - 0.5, 0, 95).round().astype(int)
        y = np.clip((np.arange(size[1]) + 0.5) / scale - 0.5, 0, 63).round().astype(int)
        assert np.abs(small - whole[np.ix_(y, x)]).mean() < 0.03


def test_one_pixel():
    layer = engine.peel(picture(width=1, height=1), [None], [engine.Fill.push_pull], [0.0])
    renderer = engine.FrameRenderer((1, 1), 1.0, engine.View(), engine.Wind(), [engine.Layer(layer[0], motion=engine.Drift())])
    states = [engine.LayerState(motion=engine.Drift(offset=(0.3, 0.4)))]
    assert np.allclose(renderer.render(engine.Moment(), engine.Moment(), states, states).combined, layer[0].pixels, atol=1e-6)


def test_layers_of_their_own_give_the_whole():
    frame = Stage(image=smooth_picture()).frame(12, layers=True)
    whole = np.zeros_like(frame.combined)
    for layer in reversed(frame.layers):
        whole = layer + (1 - layer[..., 3:]) * whole
    assert np.abs(whole - frame.combined).max() < 2e-4


def test_without_flow_there_is_none():
    assert Stage().frame(3, flow=False).flow.size == 0


@pytest.mark.parametrize(
    "change, sentence",
    [
        ({"ties": [{"follows": 1}, {"water": 4, "follows": 0}, *TIES[2:]]}, "depends on itself in a circle"),
        ({"ties": [{}, {"water": 0}, *TIES[2:]]}, r"layers\[1\].water: not the index of a ripple layer"),
        ({"ties": [{"follows": 9}, *TIES[1:]]}, r"layers\[0\]: layer 9 is not there"),
        ({"scale": 0.0}, "scale: 0 is not between 0.001 and 16"),
    ],
)
def test_what_hangs_together_wrongly_is_refused(change, sentence):
    with pytest.raises(ValueError, match=sentence):
        Stage(**change)


def test_another_kind_of_motion_than_set_up_is_refused():
    stage = Stage()
    states = stage.states(1)
    with pytest.raises(ValueError, match=r"layers\[0\]: another kind of motion"):
        stage.renderer.render(stage.moment(1), stage.moment(2), [engine.LayerState(), *states[1:]], states)
    with pytest.raises(ValueError, match="states: 2 is not one for each of 6 layers"):
        stage.renderer.render(stage.moment(1), stage.moment(2), states[:2], states[:2])


def test_a_layer_outside_the_picture_is_refused():
    layer = engine.LayerImage(np.ones((4, 4, 4), np.float32), (94, 0, 4, 4))
    with pytest.raises(ValueError, match=r"layers\[0\]: its box does not fit"):
        engine.FrameRenderer((96, 64), 1.0, engine.View(), engine.Wind(), [engine.Layer(layer)])
