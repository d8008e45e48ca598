"""A layer that flows like a clip: alone, in any order, by any number of threads, at rest, in a loop; what of its recipe counts."""

import json
import shutil
import subprocess
from types import SimpleNamespace

import numpy as np
import pytest
from made_ready import made_ready, picture, renderer, same
from PIL import Image
from scipy.ndimage import gaussian_filter
from stillwater import Live, RecipeError, load
from stillwater import _stillwater as engine
from stillwater.recipe.animation import Loop
from stillwater.recipe.fluids import Example
from stillwater.render.cache import FOLDER, Cache
from stillwater.render.events import Preparing, Warn
from stillwater.render.filming import ExampleTrack, Pace
from stillwater.render.keys import FrameKeys
from stillwater.render.loop import Job, Order
from stillwater.render.preview import prepare

pytestmark = pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed: there is no clip to read")

WIDTH, HEIGHT = 160, 120
POND = (slice(16, 112), slice(12, 148))
ACROSS = {"points": [[20, 64], [140, 64]], "speed": 1.5}
CLIP_FRAMES = 24


def noise(height, width, seed=4):
    """Of several sizes, in one hue."""
    grey = np.random.default_rng(seed).normal(size=(height, width, 1))
    many = sum(gaussian_filter(grey, (s, s, 0)) * s * a for s, a in ((1.2, 0.2), (3, 0.3), (8, 0.3)))
    return np.clip(0.45 + many * (1, 0.9, 0.7), 0, 1)


@pytest.fixture(scope="session")
def clip(tmp_path_factory):
    """A texture that runs to the right by 2 px a frame and changes on its way."""
    path = tmp_path_factory.mktemp("clip") / "clip.mp4"
    first, second = noise(80, 180, 1), noise(80, 180, 2)
    frames = []
    for t in range(CLIP_FRAMES):
        share = 0.5 - 0.5 * np.cos(2 * np.pi * t / 17)
        frames.append(((1 - share) * first + share * second)[:, 2 * (CLIP_FRAMES - t) : 2 * (CLIP_FRAMES - t) + 112])
    pixels = (255 * np.array(frames)).round().astype(np.uint8)
    command = "ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s 112x80 -r 24 -i - -c:v libx264 -qp 4 -pix_fmt yuv444p"
    subprocess.run([*command.split(), str(path)], input=pixels.tobytes(), check=True, timeout=60)
    return path


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)


@pytest.fixture
def brook(tmp_path, clip):
    """`brook(change, picture)`: a textured pond that flows like the clip; answers the recipe's path."""

    def write(change=lambda recipe: None, picture=None):
        image = noise(HEIGHT, WIDTH) if picture is None else picture
        Image.fromarray((255 * image).round().astype(np.uint8)).save(tmp_path / "picture.png")
        matte = np.zeros((HEIGHT, WIDTH), np.uint8)
        matte[POND] = 255
        Image.fromarray(matte).save(tmp_path / "matte.png")
        shutil.copy(clip, tmp_path / "clip.mp4")
        motion = {"type": "example", "clip": "clip.mp4", "strokes": [ACROSS], "refine": {"amount": 0}, "life": 8,
                  "average_blur": 3, "grid": [3, 2], "repetitions": 1}  # fmt: skip
        pond = {"name": "pond", "matte": {"file": "matte.png"}, "fill": {"method": "none"}, "motion": motion}
        recipe = {"stillwater": 1, "picture": "picture.png", "frames": [1, 24], "layers": [pond, {"name": "bank"}],
                  "output": {"depth": "float"}}  # fmt: skip
        change(recipe)
        (tmp_path / "recipe.json").write_text(json.dumps(recipe))
        return tmp_path / "recipe.json"

    return write


def film(**fields):
    return lambda recipe: recipe["layers"][0]["motion"].update(fields)


def looping(last=24, **fields):
    def change(recipe):
        recipe.update(loop=True, frames=[1, last])
        film(**fields)(recipe)

    return change


def test_the_pond_changes_and_nothing_else(brook):
    path = brook()
    frames = renderer(path)
    moved = np.abs(frames.frame(5).combined - picture(path)).max(axis=2)
    assert (moved[POND] > 0.03).mean() > 0.5
    moved[POND] = 0
    assert not moved.any()
    assert np.abs(frames.frame(5).combined - frames.frame(6).combined)[POND].mean() > 0.005


def test_any_frame_alone_and_in_any_order(brook):
    path = brook(film(speed={"first": 1, "values": [1, 2, 0.5]}))
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


@pytest.mark.parametrize("change", [film(speed=0), film(strokes=[{**ACROSS, "speed": 0}])], ids=["speed", "strokes"])
def test_at_rest_it_is_the_picture(brook, change):
    path = brook(change)
    frame = renderer(path).frame(9)
    assert np.array_equal(frame.combined, picture(path)) and not frame.flow.any()


@pytest.mark.parametrize("last", [10, 24, 60])
@pytest.mark.parametrize("speed", [1, {"first": 1, "values": [1, 1.5, 2, 1.5, 1]}], ids=["steady", "keyed"])
def test_a_loop_closes_to_the_byte(brook, last, speed):
    frames = renderer(brook(looping(last, speed=speed)))
    assert same(frames.frame(5), frames.frame(5 + last)) and same(frames.frame(last), frames.frame(0))
    steps = [np.abs(frames.frame(t).combined - frames.frame(t + 1).combined).mean() for t in range(last - 4, last + 1)]
    assert steps[-1] < 2 * np.median(steps)


def test_it_goes_on_for_ever_and_where_not_it_stands(brook):
    endless, ending = renderer(brook()), renderer(brook(film(endless=False)))
    assert not same(endless.frame(200), endless.frame(201))
    assert same(ending.frame(200), ending.frame(201)) and not same(ending.frame(1), ending.frame(2))
    assert not ending.frame(200).flow.any()


def test_what_is_frozen_stays(brook):
    path = brook(film(freeze=[{"points": [[30, 40], [60, 40]], "width": 16}]))
    frames, still = renderer(path), picture(path)
    for t in (2, 9, 16):
        np.testing.assert_allclose(frames.frame(t).combined[36:44, 32:58], still[36:44, 32:58], atol=1e-6)


def test_the_flow_channel_is_the_field(brook):
    frame = renderer(brook()).frame(4)
    assert np.allclose(frame.flow[60:70, 60:100], (1.5, 0), atol=0.05)
    assert not frame.flow[:10].any()


def test_flow_and_picture_are_in_output_pixels(brook):
    path = brook()
    double, half = (renderer(path, scale=scale).frame(6) for scale in (2, 0.5))
    assert np.allclose(double.flow[120:140, 120:200], (3, 0), atol=0.1)
    assert np.allclose(half.flow[30:35, 30:50], (0.75, 0), atol=0.05)


def test_it_looks_like_the_picture_and_moves_like_the_clip(brook):
    path = brook()
    frames, still = renderer(path), picture(path)
    shown = np.array([frames.frame(t).combined[POND][..., 1] for t in range(1, 17)])
    assert abs(shown.mean() - still[POND][..., 1].mean()) < 0.02
    assert shown.std(axis=(1, 2)).mean() == pytest.approx(still[POND][..., 1].std(), rel=0.15)
    moving = shown - shown.mean(axis=0)  # some of the picture's detail stands, as some of the clip's does
    along = np.concatenate([engine.optical_flow(moving[t], moving[t + 1], "medium")[20:-20, 20:-20, 0] for t in (2, 7, 12)])
    assert 0.7 < np.median(along) < 2.3


def test_strokes_of_two_frames_blend(brook):
    down = {"points": [[80, 20], [80, 110]], "speed": 1.5}
    frames = renderer(brook(film(strokes=[{**ACROSS, "frame": 5}, {**down, "frame": 9}])))
    flows = [frames.frame(t).flow[90:100, 110:130].mean(axis=(0, 1)) for t in (1, 5, 7, 9, 20)]
    assert np.array_equal(flows[0], flows[1]) and np.array_equal(flows[3], flows[4])
    assert np.allclose(flows[2], (flows[1] + flows[3]) / 2, atol=0.05)


def test_a_picture_with_alpha_keeps_it(brook):
    path = brook()
    rgba = picture(path)
    rgba[..., 3] = np.linspace(0.2, 1, WIDTH)
    rgba[..., :3] *= rgba[..., 3:]
    engine.write_picture(str(path.parent / "picture.png"), rgba)
    frame = renderer(path).frame(5).combined
    np.testing.assert_allclose(frame[..., 3], picture(path)[..., 3], atol=1e-5)


def test_what_has_been_made_is_found_again(brook):
    path = brook()
    made = [event.what for event in made_ready(path)[1] if isinstance(event, Preparing)]
    assert made[-5:-1] == ["making pond flow", "taking the clip of pond apart", "laying the clip over pond",
                           "making the clip look like pond"]  # fmt: skip
    assert [event for event in made_ready(path)[1] if isinstance(event, Preparing)] == []


@pytest.mark.parametrize(
    ("change", "anew"),
    [
        ({"speed": 2}, []),
        ({"shutter": 0.5}, ["making the clip look like pond"]),
        ({"transfer": {"patch": 12}}, ["laying the clip over pond", "making the clip look like pond"]),
        ({"strokes": [{**ACROSS, "speed": 3}]}, ["making pond flow", "laying the clip over pond", "making the clip look like pond"]),
        ({"clip_frames": [3, 20]}, ["taking the clip of pond apart", "laying the clip over pond", "making the clip look like pond"]),
    ],
)
def test_only_what_depends_on_a_change_is_made_anew(brook, change, anew):
    renderer(brook())
    events = made_ready(brook(film(**change)))[1]
    assert [event.what for event in events if isinstance(event, Preparing)] == anew


CHANGES = {
    "clip_frames": [3, 22],
    "strokes": [{**ACROSS, "speed": 3}],
    "refine": {"amount": 1},
    "speed": 1.7,
    "freeze": [{"points": [[60, 60], [80, 60]]}],
    "life": 5,
    "shutter": 1.0,
    "average_blur": 9,
    "grid": [2, 2],
    "repetitions": 2,
    "matching": "none",
    "transfer": {"patch": 24},
    "clip_scale": 1.5,
    "clip_fps": 12,
    "clip_steady": True,
    "endless": False,
    "stylize": 0.3,
    "outline": {"moving": True},
}


@pytest.mark.parametrize("name", CHANGES)
def test_every_field_changes_the_frames_and_their_keys(brook, name):
    def look(path, frame):
        job = Job(load(path), Order())
        return renderer(path).frame(frame).combined, job.keys.of(frame)

    (before, key), (after, new_key) = (look(brook(film(**change)), 30) for change in ({}, {name: CHANGES[name]}))
    assert not np.array_equal(before, after) and key != new_key


def test_the_table_above_has_every_field():
    assert set(Example.__struct_fields__) - set(CHANGES) == {"clip"}  # another file, below


def test_transfer_strokes_and_order_count(brook):
    clone = {"source": [[20, 20], [60, 20]], "target": [[40, 40], [100, 80]], "width": 40}
    changes = ({}, {"transfer": {"strokes": [clone]}}, {"transfer": {"order": "best-first"}})
    frames = [renderer(brook(film(**change))).frame(3).combined for change in changes]
    assert not np.array_equal(frames[0], frames[1]) and not np.array_equal(frames[0], frames[2])


def test_another_clip_under_the_same_name_is_another_key(brook):
    def keys(path):
        return Job(load(path), Order()).keys.of(3)

    path = brook()
    before = keys(path)
    data = (path.parent / "clip.mp4").read_bytes()
    (path.parent / "clip.mp4").write_bytes(data + b"\0")
    assert keys(path) != before
    assert isinstance(Job(load(path), Order()).keys, FrameKeys)


def test_live_frames_come_from_what_is_prepared(brook, tmp_path):
    path = brook()
    live, recipe = Live(), json.loads(path.read_text())
    assert not live.take(recipe, tmp_path, 96)
    *_, ready = prepare(load(path), 96, Cache(tmp_path / FOLDER))
    live.learn(ready.files)
    assert live.take(recipe, tmp_path, 96)
    first, second = (engine.scene_to_display(live.frame(t))[::-1].copy() for t in (6, 7))
    assert first.shape == (72, 96, 4) and np.abs(first - second).mean() > 0.002
    film(speed=2)(recipe)
    assert live.take(recipe, tmp_path, 96)
    film(life=4)(recipe)
    assert not live.take(recipe, tmp_path, 96)


def test_a_clip_s_oddities_are_warnings(brook, tmp_path, clip):
    path = brook()
    command = ["ffmpeg", "-v", "error", "-y", "-i", clip, "-vf", "fps=48", "-c:v", "libx264", "-qp", "4", tmp_path / "clip.mp4"]
    subprocess.run([*map(str, command)], check=True, timeout=60)
    said = [event.sentence for event in made_ready(path)[1] if isinstance(event, Warn)]
    assert len(said) == 2 and all(sentence.startswith("layers[0].motion.clip: ") for sentence in said)
    assert "repeat the one before" in said[0] and "moves as one" in said[1]


def test_frames_that_come_unevenly_are_told(brook, tmp_path, clip):
    path = brook()
    uneven = "select='not(eq(n,7)+eq(n,8)+eq(n,15))'"
    command = ["ffmpeg", "-v", "error", "-y", "-i", clip, "-vf", uneven, "-fps_mode", "vfr", "-c:v", "libx264",
               "-qp", "4", tmp_path / "clip.mp4"]  # fmt: skip
    subprocess.run([*map(str, command)], check=True, timeout=60)
    said = [event.sentence for event in made_ready(path)[1] if isinstance(event, Warn)]
    assert said[0] == (
        "layers[0].motion.clip: its frames come unevenly (up to 3 times as long after each other as they use to); taken as even"
    )


def test_a_clip_that_is_transparent_is_told(brook, tmp_path, clip):
    path = brook()
    command = ["ffmpeg", "-v", "error", "-y", "-i", clip, "-vf", "format=rgba,geq=r='p(X,Y)':g='p(X,Y)':b='p(X,Y)':a='128+X'",
               "-c:v", "png", "-f", "mov", tmp_path / "clip.mp4"]  # fmt: skip
    subprocess.run([*map(str, command)], check=True, timeout=60)
    said = [event.sentence for event in made_ready(path)[1] if isinstance(event, Warn)]
    assert said[0] == "layers[0].motion.clip: it is transparent in places; it is taken over black"


def test_a_clip_that_shakes_is_held_still_where_asked(brook):
    said = [event.sentence for event in made_ready(brook(film(clip_steady=True)))[1] if isinstance(event, Warn)]
    assert said[0].startswith("layers[0].motion.clip: held still; the camera shook by up to ")


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"clip": "gone.mp4"}, "layers[0].motion.clip: "),
        ({"clip": "picture.png"}, "layers[0].motion.clip: "),
        ({"clip_frames": [4, 40]}, "layers[0].motion.clip_frames: 40 is not a frame of the clip (1 to 24)"),
        ({"clip_frames": [4, 5]}, "layers[0].motion.clip_frames: 2 frames are not at least 3"),
        ({"life": 24}, "layers[0].motion.life: 24 is not below the clip's 24 frames"),
        ({"grid": [64, 64]}, "layers[0].motion.grid: 64 x 64 is not one whose cells have at least 8 pixels a side"),
        ({"transfer": {"patch": 100}}, "layers[0].motion.transfer.patch: 100 px is not within the clip's 112 x 80 px"),
        ({"strokes": [{"points": [[900, 900], [990, 990]]}]}, "layers[0].motion.strokes: none that touches the picture"),
        ({"freeze": [{"points": [[30, 40]], "width": 0.5}]}, None),
    ],
)
def test_bad_input_is_a_sentence(brook, change, sentence):
    path = brook(film(**change))
    if sentence is None:
        renderer(path)
        return
    with pytest.raises(RecipeError) as refused:
        renderer(path)
    assert refused.value.problems[0].startswith(sentence)


def test_it_neither_follows_nor_is_followed(brook):
    def follow(recipe):
        recipe["layers"][0]["follows"] = {"layer": "bank"}

    with pytest.raises(RecipeError, match="a layer that flows follows no other"):
        renderer(brook(follow))


def test_it_can_be_cancelled_while_the_clip_is_taken_apart(brook):
    class Stop(Exception):
        pass

    told = False

    def beat():
        if told:
            raise Stop

    job = Job(load(brook()), Order())
    list(job.check_files())
    steps = job.ready(SimpleNamespace(beat=beat))
    with pytest.raises(Stop):
        for event in steps:
            told = told or event.what == "taking the clip of pond apart"


def test_a_clip_s_time_is_its_own():
    example = Example(clip="c.mp4", speed=2.0, life=10)
    free = Pace.of(ExampleTrack(example, None), 12, 50, 24)
    assert (free.steps, free.period, free.moment(0), free.moment(8)) == (0.5, 0, 11, 15)
    looped = Pace.of(ExampleTrack(example, Loop(1, 25)), 12, 50, 24)  # 50 frames at speed 1: 25 steps
    assert looped.period == 25 and looped.moment(50) - looped.moment(0) == 25
    unknown = Pace.of(ExampleTrack(example, None), 0, 50, 24)
    assert unknown.steps == 1
    ending = Pace.of(ExampleTrack(Example(clip="c.mp4", life=10, endless=False), None), 24, 50, 24)
    assert ending.moment(1000) == 49 and ending.moment(-1000) == 11
