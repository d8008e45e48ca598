"""What a screen shows of a moment: the frame, as Blender keeps pictures; a layer alone; where points are."""

import numpy as np
import pytest
import stage
from stillwater import _stillwater as engine


@pytest.fixture(scope="module")
def scene():
    return stage.Stage()


def shown(scene, frame, size=(64, 96), **wish):
    pixels = np.full((*size, 4), np.nan, np.float32)
    scene.renderer.render_for_screen(pixels, scene.moment(frame), scene.states(frame), **wish)
    return pixels


def assert_shows(pixels, picture):
    """Pixels as Blender keeps them show the picture, within what display_to_screen allows: 1/40 of a level of 256."""
    np.testing.assert_allclose(engine.scene_to_display(pixels)[::-1], picture, rtol=1e-5, atol=1 / 40 / 255)
    np.testing.assert_array_equal(pixels[::-1, :, 3], picture[..., 3])


@pytest.mark.parametrize("frame", [1, 7, 300])
def test_it_is_the_frame_in_scene_linear_bottom_row_first(scene, frame):
    assert_shows(shown(scene, frame), scene.frame(frame).combined)


@pytest.mark.parametrize("layer", range(6))
def test_a_layer_alone_is_that_of_the_frame_s_layers(scene, layer):
    alone = scene.frame(5, layers=True).layers[layer]
    assert_shows(shown(scene, 5, layer=layer), alone)
    grey = shown(scene, 5, layer=layer, coverage=True)
    covered = np.dstack([alone[..., 3]] * 3 + [np.ones_like(alone[..., 3])])
    assert_shows(grey, covered)


def test_the_picture_s_own_alpha_comes_with_it():
    alpha = np.full((stage.HEIGHT, stage.WIDTH), 0.5, np.float32)
    scene = stage.Stage(alpha=alpha)
    assert_shows(shown(scene, 3), scene.frame(3).combined)
    assert abs(shown(scene, 3)[..., 3].mean() - 0.5) < 0.01


def test_points_are_where_their_layer_is(scene):
    states, moment = scene.states(9), scene.moment(9)
    tree = engine.SwayMotion(stage.MOTIONS[0], scene._wind(1), (stage.WIDTH, stage.HEIGHT)).at(moment, stage.MOTIONS[0])
    points = [(18.0, 50.0), (18.0, 4.0), (20.0, 30.0)]
    wanted = tree.map(np.array([points], np.float32))[0]
    np.testing.assert_allclose(scene.renderer.moved(stage.MATTES.index(stage.TREE), moment, states, points), wanted, atol=1e-4)
    assert scene.renderer.moved(5, moment, states, points) == points  # the background is still
    assert scene.renderer.moved(3, moment, states, [(1, 1)])[0] == pytest.approx((1 + 0.8 * 8, 1))


def test_what_is_not_there_is_refused(scene):
    with pytest.raises(ValueError, match="layer: 6 is not between 0 and 5"):
        shown(scene, 1, layer=6)
    with pytest.raises(ValueError, match="layer: -1 is not between 0 and 5"):
        scene.renderer.moved(-1, scene.moment(1), scene.states(1), [(0, 0)])
    with pytest.raises(ValueError, match="out: not of the renderer's size"):
        shown(scene, 1, size=(64, 95))


@pytest.mark.parametrize("scale", [1.0, 0.5, 0.37, 2.0])
@pytest.mark.parametrize("velocity", [None, (0.8, 0.0), (0.3, 0.4)])
def test_plates_made_before_give_the_same_frame(scale, velocity):
    """... for other numbers too: a layer's plates do not depend on them."""
    clouds = engine.peel(stage.picture(), [stage.CLOUDS, None], [stage.PUSH_PULL] * 2, [0.0, 0.0])
    size, view, wind = (stage.WIDTH, stage.HEIGHT), engine.View(), engine.Wind()
    endless = (True, bool(velocity and velocity[1]))
    motion = engine.Drift() if velocity else engine.Sway(armature=((48, 30), (48, 0)))
    plates = engine.make_plates(clouds[0], None, size, scale, endless if velocity else None)
    behind = engine.make_plates(clouds[1], None, size, scale, None)

    def frame(images, frame):
        layers = [engine.Layer(images[0], motion, endless=endless), engine.Layer(images[1])]
        renderer = engine.FrameRenderer(size, scale, view, wind, layers)
        now = engine.Moment(frame=frame, wind=engine.Wind(speed=9))
        moved = engine.Drift(offset=tuple(v * frame for v in velocity)) if velocity else motion
        states = [engine.LayerState(1.0, moved), engine.LayerState()]
        return renderer.render(now, now, states, states).combined

    for number in (0, 40):
        np.testing.assert_array_equal(frame([plates, behind], number), frame(clouds, number))
