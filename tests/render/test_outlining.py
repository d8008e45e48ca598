"""Outlines that move: they follow the film, keep their area, stand alone at any frame, and come round in a loop."""

import json
import shutil

import numpy as np
import pytest
from made_ready import made_ready, renderer, same
from PIL import Image
from scipy.ndimage import gaussian_filter
from stillwater import Live, RecipeError, linear_to_srgb, load
from stillwater import _stillwater as engine
from stillwater.render import outlines
from stillwater.render.cache import FOLDER, Cache
from stillwater.render.events import Preparing, Warn
from stillwater.render.loop import Job, Order
from stillwater.render.outlining import SPAN
from stillwater.render.preview import prepare

WIDTH, HEIGHT = 120, 140
MOVING = {"moving": True}
EARLY, LATE = ({"first": 1, "values": [1.0] * 65 + [last]} for last in (1.2, 1.3))  # the second span reads it
UP = {"points": [[60, 110], [60, 20]], "speed": 2}


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)


@pytest.fixture
def fire(tmp_path):
    """`fire(change)`: a textured flame before black, that burns upwards; answers the recipe's path."""

    def write(change=lambda recipe: None, outline=MOVING, middle=75, **fields):
        y, x = np.mgrid[:HEIGHT, :WIDTH]
        noise = gaussian_filter(np.random.default_rng(5).normal(size=(HEIGHT, WIDTH)), (4, 2))
        flame = np.clip(0.6 + 0.25 * noise / noise.std(), 0.2, 1)[..., None] * (1, 0.6, 0.2)
        matte = np.clip((28 - np.hypot((x - 60) * 1.2, (y - middle) * 0.7)) / 4 + 0.5, 0, 1)
        pictures = {"picture.png": flame * matte[..., None], "matte.png": matte, "behind.png": np.zeros((HEIGHT, WIDTH, 3))}
        for name, image in pictures.items():
            Image.fromarray((255 * image).round().astype(np.uint8)).save(tmp_path / name)
        motion = {"type": "flow", "strokes": [UP], "period": 24, "refine": {"amount": 0}, "outline": outline}
        burning = {"name": "flame", "matte": {"file": "matte.png"}, "fill": {"file": "behind.png"}, "motion": {**motion, **fields}}
        recipe = {"stillwater": 1, "picture": "picture.png", "frames": [1, 60], "layers": [burning, {"name": "night"}],
                  "output": {"depth": "float", "layers": True}}  # fmt: skip
        change(recipe)
        (tmp_path / "recipe.json").write_text(json.dumps(recipe))
        return tmp_path / "recipe.json"

    return write


def looping(last=24):
    return lambda recipe: recipe.update(loop=True, frames=[1, last])


def coverage(frame):
    return frame.layers[0][..., 3]


def test_it_moves_and_keeps_its_area(fire):
    frames = renderer(fire())
    first = coverage(frames.frame(1))
    still = coverage(renderer(fire(outline={"moving": False})).frame(1))
    assert np.abs(first - still).max() < 1.5 / 255
    for t in (2, 10, 30, 60):
        now = coverage(frames.frame(t))
        assert abs(now.sum() / first.sum() - 1) < 0.01
        assert t == 2 or np.abs(now - first).max() > 0.2
    assert np.abs(coverage(frames.frame(31)) - coverage(frames.frame(30))).max() > 0.01  # it lives on


def test_it_goes_with_the_fluid(fire):
    """Fluid that rises carries its outline up."""
    y = np.arange(HEIGHT)[:, None]

    def height(frame):
        return float((coverage(frame) * y).sum() / coverage(frame).sum())

    frames = renderer(fire())
    assert height(frames.frame(20)) < height(frames.frame(1)) - 1
    assert height(renderer(fire(outline={"moving": True, "persistence": 0.3})).frame(20)) > height(frames.frame(20))


def test_the_film_beside_it_is_the_film(fire):
    """Inside, colours are those of the layer without an outline: nothing of the matte's old border shows."""
    frame = renderer(fire()).frame(25)
    layer = frame.layers[0]
    some = layer[..., 3] > 0.1
    straight = layer[some][:, :3] / layer[some][:, 3:]
    assert straight[:, 0].min() > 0.15  # black, the picture around the flame, is nowhere in it


def test_any_frame_alone_in_any_order_and_by_any_number_of_threads(fire, tmp_path):
    path = fire(speed={"first": 1, "values": [1, 2, 0.5]})
    first = renderer(path)
    forwards = {t: first.frame(t) for t in (3, 17, 55)}
    for threads in (1, 3):
        shutil.rmtree(tmp_path / FOLDER)
        engine.set_threads(threads)
        assert all(same(renderer(path).frame(t), forwards[t]) for t in (55, 3, 17))


def test_spans_go_on_where_the_one_before_ended(fire, monkeypatch, tmp_path):
    path = fire()
    parts = [renderer(path).frame(t) for t in (SPAN - 1, SPAN, SPAN + 1, 60)]
    shutil.rmtree(tmp_path / FOLDER)
    monkeypatch.setattr("stillwater.render.outlining.SPAN", 100)
    assert all(same(renderer(path).frame(t), part) for t, part in zip((SPAN - 1, SPAN, SPAN + 1, 60), parts, strict=True))


def test_a_loop_comes_round(fire):
    frames = renderer(fire(looping()))
    assert same(frames.frame(1), frames.frame(25)) and same(frames.frame(24), frames.frame(0))
    every = [coverage(frames.frame(t)) for t in range(1, 26)]
    steps = [np.abs(b - a).mean() for a, b in zip(every, every[1:], strict=False)]
    assert steps[-1] < 1.2 * max(steps[:-1])


def test_outside_of_the_frames_it_stands(fire):
    frames = renderer(fire())
    assert np.array_equal(coverage(frames.frame(60)), coverage(frames.frame(80)))
    assert np.array_equal(coverage(frames.frame(1)), coverage(frames.frame(-5)))


@pytest.mark.parametrize("rest", [{"speed": 0}, {"outline": {"moving": False, "persistence": 0.2}}, {"outline": None}])
def test_what_does_not_move_keeps_its_matte(fire, rest):
    events = made_ready(path := fire(**rest))[1]
    assert not [event for event in events if "outline" in getattr(event, "what", "")]
    still = renderer(fire(outline={"moving": False})).frame(9)
    assert np.array_equal(coverage(renderer(path).frame(9)), coverage(still))


def test_only_what_depends_on_a_change_is_made_anew(fire):
    def made(path):
        return [event.what for event in made_ready(path)[1] if isinstance(event, Preparing) and event.share == 0.95]

    following = "following the outline of flame"
    assert made(fire())[-2:] == [following] * 2
    assert made(fire()) == []
    assert made(fire(outline={"moving": True, "persistence": 0.5})) == ["making flame flow", following, following]
    made(fire(speed=EARLY))
    assert made(fire(speed=LATE)) == [following]
    assert made(fire(lambda recipe: recipe.update(frames=[1, 100]))) == [following] * 2


def test_keys_hold_what_an_outline_has_followed(fire):
    def keys(path, *frames):
        job = Job(load(path), Order())
        return [job.keys.of(frame) for frame in frames]

    usual = keys(fire(), 5, 55)
    assert keys(fire(lambda recipe: recipe.update(frames=[1, 96])), 5)[0] == usual[0]
    assert keys(fire(outline={"moving": True, "persistence": 0.8}), 5)[0] != usual[0]
    early, late = keys(fire(speed=EARLY), 5, 55), keys(fire(speed=LATE), 5, 55)
    assert late[0] == early[0] and late[1] != early[1]


def test_half_as_large_it_is_the_same_outline(fire):
    def reduced(image):
        return image.reshape(HEIGHT // 2, 2, WIDTH // 2, 2).mean(axis=(1, 3))

    small = fire(lambda recipe: recipe["output"].update(scale=0.5))
    half = coverage(renderer(small, scale=0.5).frame(12))
    whole = reduced(coverage(renderer(fire()).frame(12)))
    assert half.shape == whole.shape and np.abs(half - whole).mean() < 0.02


def test_a_layer_at_the_picture_s_side_goes_on_to_it(fire):
    """The room around a layer ends where the picture does; its outline does not."""
    frame = renderer(fire(middle=20)).frame(20)
    assert coverage(frame)[:3].max(axis=1).min() == 1


def test_live_frames_have_the_outline(fire, tmp_path):
    path = fire()
    live = Live()
    events = list(prepare(load(path), 140, Cache(tmp_path / FOLDER)))
    live.learn(events[-1].files)
    assert live.take(json.loads(path.read_text()), tmp_path, longest=140)
    shown = linear_to_srgb(live.frame(20, "flame", matte=True)[::-1])[..., 0]
    expected = coverage(renderer(path).frame(20))
    assert np.abs(shown - expected).max() < 0.01


def test_the_picture_s_own_alpha_has_the_outline(fire, tmp_path):
    """The picture's own alpha is covered by the same outline."""
    path = fire()
    with Image.open(tmp_path / "picture.png") as image:
        image.putalpha(200)
        image.save(tmp_path / "picture.png")
    frame = renderer(path).frame(20)
    assert np.abs(frame.layers[0][..., 3] - 200 / 255 * coverage(renderer(fire()).frame(20))).mean() < 0.005


def test_with_nothing_painted_behind_it_is_warned(fire):
    def said(**fields):
        path = fire(lambda recipe: recipe["layers"][0].update(fill={"method": "none"}), **fields)
        return [event.sentence for event in Job(load(path), Order()).check_files() if isinstance(event, Warn)]

    assert said() == [
        "layers[0].fill: none; where the moving outline leaves, the picture as it was is seen (exemplar or a file paints what is"
        " behind)"
    ]
    assert said(outline={"moving": False}) == []


def test_what_lasts_too_long_for_a_loop_is_said(fire):
    with pytest.raises(RecipeError) as raised:
        renderer(fire(looping(), outline={"moving": True, "persistence": 0.99}))
    assert str(raised.value) == (
        "layers[0].motion.outline.persistence: 0.99 is not between 0 and 0.98 (the recipe loops; an outline that lasts longer"
        " does not come back)"
    )


@pytest.mark.parametrize("size", [(3, 5), (15, 40), (16, 16)])
def test_also_a_small_film_is_followed(size):
    """Optical flow wants 16 px; smaller films are made larger for it."""
    matte = np.zeros(size, np.float32)
    matte[1:-1, 1:-1] = 1
    film = np.random.default_rng(1).uniform(size=(4, *size, 4)).astype(np.float32)
    found = outlines.follow(lambda frame: film[frame], matte, 0.9, matte, range(0), range(3), lambda: None)
    assert found.arrays["outlines"].shape == (3, *size) and np.array_equal(found.arrays["outlines"][0], 255 * matte)


def test_it_can_be_cancelled_while_the_film_is_followed(fire):
    job = Job(load(fire()), Order())
    list(job.check_files())

    class Ended(Exception):
        pass

    def beat():
        raise Ended

    with pytest.raises(Ended):
        for _ in job.ready(type("Worker", (), {"beat": staticmethod(beat)})):
            pass
