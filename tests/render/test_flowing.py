"""A layer that flows: alone, in any order, by any number of threads, at rest, in a loop; its colours and contrast stay."""

import json
import shutil
from types import SimpleNamespace

import numpy as np
import pytest
from made_ready import picture, renderer, same
from PIL import Image
from scipy.ndimage import gaussian_filter
from stillwater import Live, RecipeError, load
from stillwater import _stillwater as engine
from stillwater.recipe import parse
from stillwater.render.cache import FOLDER, Cache
from stillwater.render.events import Frame
from stillwater.render.flowing import FlowTrack
from stillwater.render.loop import Job, Order, render
from stillwater.render.preview import prepare
from stillwater.render.resolve import Timeline

WIDTH, HEIGHT = 192, 128
POND = (slice(24, 120), slice(16, 176))
STONE = (slice(60, 84), slice(80, 112))
ACROSS = {"points": [[20, 70], [170, 70]], "speed": 1.5}


def texture(height, width):
    """Noise of several sizes."""
    noise = np.random.default_rng(4).normal(size=(height, width, 3))
    return np.clip(0.5 + sum(gaussian_filter(noise, (s, s, 0)) * s * a for s, a in ((1.2, 0.16), (3, 0.2), (8, 0.2))), 0, 1)


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)


@pytest.fixture
def brook(tmp_path):
    """`brook(change, picture)`: a textured pond with a hole, that flows to the right; answers the recipe's path."""

    def write(change=lambda recipe: None, picture=None):
        image = texture(HEIGHT, WIDTH) if picture is None else picture
        Image.fromarray((255 * image).round().astype(np.uint8)).save(tmp_path / "picture.png")
        matte = np.zeros((HEIGHT, WIDTH), np.uint8)
        matte[POND], matte[STONE] = 255, 0
        Image.fromarray(matte).save(tmp_path / "matte.png")
        pond = {"name": "pond", "matte": {"file": "matte.png"}, "fill": {"method": "none"},
                "motion": {"type": "flow", "strokes": [ACROSS], "period": 24, "refine": {"amount": 0}}}
        recipe = {"stillwater": 1, "picture": "picture.png", "frames": [1, 24], "layers": [pond, {"name": "bank"}],
                  "output": {"depth": "float"}}
        change(recipe)
        (tmp_path / "recipe.json").write_text(json.dumps(recipe))
        return tmp_path / "recipe.json"

    return write


def flow(**fields):
    return lambda recipe: recipe["layers"][0]["motion"].update(fields)


def inner(by=4):
    """The pond, `by` px from its outline."""
    area = np.zeros((HEIGHT, WIDTH), bool)
    area[POND] = True
    area[STONE] = False
    for axis in (0, 1):
        area = np.logical_and.reduce([np.roll(area, k, axis) for k in range(-by, by + 1)])
    return area


def test_it_moves_and_only_inside_of_its_outline(brook):
    path = brook()
    moved = np.abs(renderer(path).frame(5).combined - picture(path)).max(axis=2)
    assert (moved[inner()] > 0.03).mean() > 0.5
    outside = np.ones((HEIGHT, WIDTH), bool)
    outside[POND] = False
    outside[STONE] = True
    assert not moved[outside].any()


def test_any_frame_alone_and_in_any_order(brook):
    path = brook(flow(speed={"first": 1, "values": [1, 2, 0.5]}))
    first = renderer(path)
    forwards = {t: first.frame(t) for t in (3, 4, 17)}
    assert all(same(renderer(path).frame(t), forwards[t]) for t in (17, 3, 4))


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_any_number_of_threads(brook, tmp_path, threads):
    path = brook()
    expected = renderer(path).frame(7)
    shutil.rmtree(tmp_path / FOLDER)
    engine.set_threads(threads)
    assert same(renderer(path).frame(7), expected)


def test_a_second_run_goes_on_where_the_first_was_left(brook, tmp_path):
    path = brook()
    whole = tmp_path / "whole"
    assert sum(isinstance(event, Frame) for event in render(load(path), Order(folder=whole, frames=(1, 5)))) == 5
    for event in (events := render(load(path), Order(folder=tmp_path / "parts", frames=(1, 5)))):
        if isinstance(event, Frame) and event.frame == 2:
            events.close()
    list(render(load(path), Order(folder=tmp_path / "parts", frames=(1, 5))))
    for frame in whole.iterdir():
        assert frame.read_bytes() == (tmp_path / "parts" / frame.name).read_bytes()


def test_it_can_be_cancelled_while_its_field_is_made(brook):
    class Stop(Exception):
        pass

    job = Job(load(brook()), Order())
    list(job.check_files())
    calls = []

    def beat():
        calls.append(0)
        if told:
            raise Stop

    told = False
    steps = job.ready(SimpleNamespace(beat=beat))
    with pytest.raises(Stop):
        for event in steps:
            told = told or event.what == "making pond flow"


@pytest.mark.parametrize("change", [flow(speed=0), flow(strokes=[{**ACROSS, "speed": 0}])], ids=["speed", "strokes"])
def test_at_rest_it_is_the_picture(brook, change):
    path = brook(change)
    frame = renderer(path).frame(9)
    assert np.array_equal(frame.combined, picture(path)) and not frame.flow.any()


def test_after_a_period_it_is_as_it_was(brook):
    frames = renderer(brook())
    assert same(frames.frame(1), frames.frame(25)) and same(frames.frame(-40), frames.frame(8))
    assert not same(frames.frame(1), frames.frame(2))


@pytest.mark.parametrize("speed", [1, {"first": 1, "values": [1, 1.5, 2, 1.5, 1]}], ids=["steady", "keyed"])
def test_a_loop_closes_to_the_byte(brook, speed):
    def looping(recipe):
        recipe.update(loop=True, frames=[3, 22])
        flow(speed=speed, period=9)(recipe)

    frames = renderer(brook(looping))
    assert same(frames.frame(5), frames.frame(25)) and same(frames.frame(22), frames.frame(2))
    steps = [np.abs(frames.frame(t).combined - frames.frame(t + 1).combined).mean() for t in range(3, 23)]
    assert steps[-1] < 2 * np.median(steps)


def test_a_loop_takes_the_nearest_period_that_fits():
    def cycles(period, last):
        recipe = {"stillwater": 1, "picture": "p.png", "frames": [1, last], "loop": True,
                  "layers": [{"name": "a", "motion": {"type": "flow", "strokes": [ACROSS], "period": period}}]}
        return [Timeline(parse(recipe).recipe).at(frame).layers[0].motion.cycle for frame in range(1, last + 1)]

    assert cycles(9, 20) == [i / 10 for i in range(10)] * 2
    assert cycles(500, 20)[10] == 0.5
    assert cycles(0.1, 4) == [0] * 4


def test_colour_and_contrast_stay_as_they_are(brook):
    """Of a picture with enough texture to speak of a contrast."""
    path = brook(lambda recipe: recipe.update(layers=[{**recipe["layers"][0], "matte": None}]), texture(3 * HEIGHT, 3 * WIDTH))
    frames, still = renderer(path), picture(path)
    inside = slice(12, -12), slice(12, -12)
    shown = [frames.frame(t).combined[..., :3].mean(axis=2) for t in range(1, 25, 2)]
    assert max(abs(each[inside].mean() - still[..., :3].mean(axis=2)[inside].mean()) for each in shown) < 1 / 255
    for fine, coarse in ((0.8, 3), (3, 10)):
        contrast = [(gaussian_filter(each, fine) - gaussian_filter(each, coarse))[inside].std() for each in shown]
        assert np.ptp(contrast) < 0.05 * np.mean(contrast)


def test_a_slow_change_of_colour_stays_where_it_is(brook):
    x = np.mgrid[:HEIGHT, :WIDTH][1] / WIDTH
    path = brook(picture=np.dstack([0.2 + 0.6 * x] * 3))
    frames = renderer(path)
    for t in (3, 9, 15):
        assert np.abs(frames.frame(t).combined - picture(path))[inner(30)].max() < 2.5 / 255


def test_one_colour_stays_that_colour(brook):
    path = brook(picture=np.full((HEIGHT, WIDTH, 3), (0.2, 0.6, 0.8)))
    assert np.abs(renderer(path).frame(6).combined - picture(path)).max() < 1e-5


def test_nothing_comes_from_beyond_the_outline(brook):
    """Red all around a grey pond: no red ever flows into it."""
    image = np.full((HEIGHT, WIDTH, 3), (1.0, 0, 0))
    image[POND] = np.random.default_rng(1).uniform(0.3, 0.7, (96, 160, 1))
    image[STONE] = (0, 1.0, 0)
    frames = renderer(brook(picture=image))
    for t in (1, 6, 12, 19):
        colour = frames.frame(t).combined[inner(0)]
        assert np.abs(colour[:, 0] - colour[:, 1]).max() < 1e-3


def test_what_is_frozen_stays_bit_by_bit(brook):
    path = brook(flow(freeze=[{"points": [[30, 40], [60, 40]], "width": 16}]))
    frames, still = renderer(path), picture(path)
    for t in (2, 9, 16):
        assert np.array_equal(frames.frame(t).combined[36:44, 32:58], still[36:44, 32:58])
    assert np.abs(frames.frame(9).combined - still)[90:110, 60:].max() > 0.05


def test_the_flow_channel_is_the_field(brook):
    frame = renderer(brook()).frame(4)
    assert np.allclose(frame.flow[100:112, 60:140], (1.5, 0), atol=0.05)
    assert not frame.flow[:20].any() and np.array_equal(frame.matte > 0, inner(0))


def test_the_next_frame_along_the_flow_is_this_one(brook):
    frames = renderer(brook(flow(period=200, strokes=[{**ACROSS, "speed": 1}])))
    now, after = frames.frame(51), frames.frame(52)
    back = engine.displace(after.combined, now.flow)
    area = inner(12)
    error = np.abs(back - now.combined)[area].mean()
    assert error < 0.3 * np.abs(after.combined - now.combined)[area].mean()


def test_flow_and_picture_are_in_output_pixels(brook):
    path = brook()
    whole, double, half = (renderer(path, scale=scale).frame(6) for scale in (1, 2, 0.5))
    assert np.allclose(double.flow[200:224, 120:280], (3, 0), atol=0.1)
    assert np.allclose(half.flow[50:56, 30:70], (0.75, 0), atol=0.05)
    averaged = double.combined.reshape(HEIGHT, 2, WIDTH, 2, 4).mean(axis=(1, 3))
    assert np.abs(averaged - whole.combined).mean() < 0.02


def test_a_keyed_speed_enters_through_its_integral():
    recipe = {"stillwater": 1, "picture": "p.png", "frames": [1, 9],
              "layers": [{"name": "a", "motion": {"type": "flow", "strokes": [ACROSS], "period": 4,
                                                  "speed": {"first": 1, "values": [1, 1, 1, 1, 3, 3, 3, 3, 3, 3]}}}]}  # fmt: skip
    motion = parse(recipe).recipe.layers[0].motion
    track = FlowTrack(motion, None)
    assert track.at(1).ways == (-2, -1, 0, 1, 2) and track.at(1).step == 1
    assert track.at(4).ways == (-5, -2, 0, 1, 2) and track.at(4).step == 2
    assert track.at(100).ways == (-6, -3, 0, 3, 6)


def test_strokes_of_two_frames_blend(brook):
    down = {"points": [[90, 30], [90, 110]], "speed": 1.5}
    frames = renderer(brook(flow(strokes=[{**ACROSS, "frame": 5}, {**down, "frame": 9}])))
    flows = [frames.frame(t).flow[100:110, 130:150].mean(axis=(0, 1)) for t in (1, 5, 7, 9, 20)]
    assert np.array_equal(flows[0], flows[1]) and np.array_equal(flows[3], flows[4])
    assert flows[1][0] > 1.2 and flows[3][1] > 1
    assert np.allclose(flows[2], (flows[1] + flows[3]) / 2, atol=0.02)


def test_strokes_keyed_in_a_loop_come_round(brook):
    def looping(recipe):
        recipe.update(loop=True, frames=[1, 20])
        flow(strokes=[{**ACROSS, "frame": 1}, {"points": [[90, 30], [90, 110]], "frame": 11}], period=10)(recipe)

    frames = renderer(brook(looping))
    assert same(frames.frame(4), frames.frame(24))
    assert np.allclose(frames.frame(6).flow, frames.frame(16).flow, atol=1e-4)


def test_the_pictures_own_alpha_flows_too(brook, tmp_path):
    path = brook()
    rgba = picture(path).copy()
    rgba[..., 3] = np.where((np.mgrid[:HEIGHT, :WIDTH][1] // 16) % 2, 1, 0.25)
    rgba[..., :3] *= rgba[..., 3:]
    engine.write_picture(str(tmp_path / "picture.png"), rgba)
    rest = picture(path)
    frame = renderer(path).frame(8).combined
    assert np.abs(frame - rest)[inner()][:, 3].max() > 0.3 and np.array_equal(frame[:20], rest[:20])
    assert frame[..., 3].min() > 0.2 and frame[..., 3].max() <= 1


def test_live_frames_are_the_render_s(brook, tmp_path):
    path = brook()
    *_, ready = prepare(load(path), 960, Cache(tmp_path / FOLDER))
    live = Live()
    live.learn(ready.files)
    recipe = json.loads(path.read_text())
    assert live.take(recipe, tmp_path)
    shown = engine.scene_to_display(live.frame(6))[::-1]
    np.testing.assert_allclose(shown, renderer(path).frame(6).combined, rtol=1e-5, atol=1 / 40 / 255)
    flow(speed=2, period=30)(recipe)
    assert live.take(recipe, tmp_path)
    assert np.abs(engine.scene_to_display(live.frame(6))[::-1] - shown).max() > 0.03
    flow(strokes=[{**ACROSS, "speed": 3}])(recipe)
    assert not live.take(recipe, tmp_path)


def test_a_small_preview_flows_as_the_large_one(brook, tmp_path):
    path = brook(picture=gaussian_filter(np.random.default_rng(2).random((HEIGHT, WIDTH, 3)), (6, 6, 0)) * 4 - 1.5)
    *_, ready = prepare(load(path), 96, Cache(tmp_path / FOLDER))
    live = Live()
    live.learn(ready.files)
    assert live.take(json.loads(path.read_text()), tmp_path, 96)
    small = engine.scene_to_display(live.frame(7))[::-1]
    large = renderer(path).frame(7).combined.reshape(HEIGHT // 2, 2, WIDTH // 2, 2, 4).mean(axis=(1, 3))
    still = picture(path).reshape(HEIGHT // 2, 2, WIDTH // 2, 2, 4).mean(axis=(1, 3))
    assert np.abs(small - large).mean() < 0.3 * np.abs(still - large).mean()


@pytest.mark.parametrize(
    "change, sentence",
    [
        (flow(strokes=[{"points": [[900, 900], [990, 990]]}]), "layers[0].motion.strokes: none that touches the picture is of"
         " kind orientation or both, with an alpha above 0"),
    ],
)  # fmt: skip
def test_what_only_the_picture_shows_to_be_wrong_is_said_before_any_frame(brook, tmp_path, change, sentence):
    with pytest.raises(RecipeError) as raised:
        list(render(load(brook(change)), Order()))
    assert str(raised.value) == sentence and not (tmp_path / "frames").exists()
