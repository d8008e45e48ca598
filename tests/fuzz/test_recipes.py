"""Random recipes, from the middle to the ends of every range: rendered or refused, never a crash, never a NaN."""

import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some
from PIL import Image
from stillwater import _stillwater as engine
from stillwater.recipe import RecipeError, parse
from stillwater.render.errors import Refused
from stillwater.render.loop import Order, render

WIDTH, HEIGHT = 24, 16


def number(low, high, *often):
    """Mostly sensible, sometimes the ends."""
    return some.one_of(some.sampled_from([low, high, *often]), some.floats(low, high, allow_nan=False))


def animated(low, high, *often):
    values = some.lists(number(low, high, *often), min_size=1, max_size=5)
    keys = some.fixed_dictionaries({"first": some.integers(-5, 8), "values": values})
    return some.one_of(number(low, high, *often), keys)


def parts(**fields):
    """An object with any of the fields."""
    return some.fixed_dictionaries({}, optional=fields)


near = some.floats(-10, 34)
far = number(-1e6, 1e6, 0)
place = some.lists(some.one_of(near, near, far), min_size=2, max_size=2)
line = some.tuples(place, place).filter(lambda ends: ends[0] != ends[1]).map(list)
seed = some.integers(0, 2**53)

flow_stroke = some.builds(
    lambda start, steps, more: {"points": [start, *([start[0] + x, start[1] + y] for x, y in steps)]} | more,
    some.tuples(near, near).map(list),
    some.lists(some.tuples(some.sampled_from([-9, 5, 14]), some.floats(-12, 12)), min_size=1, max_size=3),
    parts(kind=some.sampled_from(["both", "orientation", "speed"]), speed=number(0, 1000, 0, 2), local=some.booleans(),
          alpha=number(0, 1, 1), width=number(0.1, 60, 10), frame=some.integers(-3, 4)),
)
strokes = some.lists(flow_stroke, min_size=1, max_size=4)
fluid = dict(
    refine=parts(width=number(0, 1000, 12), amount=number(0, 1)),
    speed=animated(-1000, 1000, 0, 1),
    freeze=some.lists(some.fixed_dictionaries({"points": some.lists(some.tuples(near, near).map(list), min_size=1, max_size=3)}), max_size=2),
    outline=parts(moving=some.booleans(), persistence=number(0, 1, 0.9)),
)
flows = some.builds(
    lambda strokes, more: {"type": "flow", "strokes": strokes} | more, strokes, parts(**fluid, period=number(0.001, 1e6, 1, 60))
)
film = parts(
    **fluid, clip_frames=some.sampled_from([[1, 8], [2, 6], [1, 2], [5, 3]]), clip_steady=some.booleans(), life=some.sampled_from([1, 3, 5, 16]),
    shutter=number(0, 10, 0.2), average_blur=number(0, 1000, 8), grid=some.sampled_from([None, [1, 1], [3, 2], [64, 64]]),
    repetitions=some.integers(0, 3), matching=some.sampled_from(["steerable", "laplacian", "none"]), clip_scale=number(0.001, 100, 1, 0.25),
    clip_fps=some.one_of(some.none(), number(1e-3, 1000, 24)), endless=some.booleans(), stylize=number(0, 1, 1),
    transfer=parts(patch=some.sampled_from([4, 8, 128]), order=some.sampled_from(["best-last", "best-first"])),
)  # fmt: skip
films = some.builds(lambda strokes, more: {"type": "example", "clip": "clip.mp4", "strokes": strokes, "life": 4} | more, strokes, film)

motions = some.one_of(
    parts().map(lambda m: {"type": "still"} | m),
    some.builds(
        lambda armature, more: {"type": "sway", "armature": armature} | more,
        line,
        parts(frequency=animated(1e-6, 100, 0.6), mass=number(1e-6, 1e6, 1), damping=number(1e-6, 1000, 0.4),
              amount=animated(0, 1000, 1), foreshortening=number(0, 1), shimmer=number(0, 1), seed=seed),
    ),
    some.builds(
        lambda more: {"type": "ripple", "resolution": 16} | more,
        parts(amplitude=animated(0, 1000, 1), roughness=number(1e-4, 1e4, 1), tile=number(10, 2000, 60),
              mode=some.sampled_from(["height", "normal"]),
              spectrum=some.sampled_from(["phillips", "pierson-moskowitz", "jonswap", "tma"]),
              fetch=number(1e-6, 1e5, 100), depth=number(1e-6, 12000, 200), seed=seed,
              resolution=some.sampled_from([16, 32, 64])),
    ),
    some.builds(
        lambda waterline, more: {"type": "bob", "waterline": waterline, "water": "water"} | more,
        some.lists(place, min_size=2, max_size=4),
        parts(amount=animated(0, 1000, 1)),
    ),
    parts(wind=number(-1000, 1000, 0.5)).map(lambda m: {"type": "drift"} | m),
    some.tuples(number(-1e4, 1e4, 0, 1), number(-1e4, 1e4, 0)).map(lambda v: {"type": "drift", "velocity": list(v)}),
    flows,
    *([films] if shutil.which("ffmpeg") else []),  # without it there is no clip
)  # fmt: skip

mattes = some.one_of(
    some.integers(0, 4).map(lambda value: {"labels": "labels.png", "value": value}),
    some.sampled_from([{"file": "soft.png"}, {"file": "white.png"}]),
)


@some.composite
def layers(draw):
    names = [f"layer {i}" for i in range(draw(some.integers(0, 3)))]
    made = []
    for i, name in enumerate(names):
        layer = {"name": name, "matte": draw(mattes), "motion": draw(motions)}
        layer |= draw(parts(visible=some.booleans(), opacity=animated(0, 1, 1), feather=number(0, 1000, 0, 2),
                            fill=some.sampled_from([{"method": "none"}, {"method": "exemplar"}, {"file": "picture.png"}])))  # fmt: skip
        if i and draw(some.booleans()):
            layer["follows"] = {"layer": draw(some.sampled_from(names[:i])), "mirror": draw(some.booleans())}
        made.append(layer)
    water = {"name": "water", "matte": draw(mattes), "motion": draw(motions.filter(lambda m: m["type"] == "ripple"))}
    return [*made, water, {"name": "back", "motion": draw(motions.filter(lambda m: m["type"] != "bob"))}]


recipes = some.builds(
    lambda fixed, more: fixed | more,
    some.fixed_dictionaries(
        {
            "stillwater": some.just(1),
            "picture": some.sampled_from(["picture.png", "clear.png"]),
            "frames": some.integers(-3, 3).map(lambda first: [first, first + 2]),
            "layers": layers(),
            "view": some.fixed_dictionaries(
                {"horizon": line}, optional={"fov": number(5, 150, 50), "height": number(1e-6, 1e5, 1.7)}
            ),
        }
    ),
    parts(
        fps=number(0.001, 1000, 24), seed=seed, loop=some.booleans(),
        wind=parts(speed=animated(0, 40, 5), direction=animated(-36000, 36000, 0, 90), gusts=animated(0, 1, 0),
                   gust_size=number(1e-6, 100, 0.25), seed=seed),
        output=parts(scale=some.sampled_from([0.001, 0.5, 1, 2.3]), layers=some.booleans(),
                     depth=some.sampled_from(["half", "float"])),
    ),
)  # fmt: skip


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pictures")
    random = np.random.default_rng(5)
    colours = random.integers(0, 256, (HEIGHT, WIDTH, 4)).astype(np.uint8)
    Image.fromarray(colours[..., :3]).save(folder / "picture.png")
    Image.fromarray(colours).save(folder / "clear.png")
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    Image.fromarray((y // 6 + (x > 12)).astype(np.uint8)).save(folder / "labels.png")
    Image.fromarray(np.clip(255 * (6 - np.hypot(x - 12, y - 8)), 0, 255).astype(np.uint8)).save(folder / "soft.png")
    Image.new("L", (WIDTH, HEIGHT), 255).save(folder / "white.png")
    if shutil.which("ffmpeg"):
        coding = "ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s 48x40 -r 24 -i - -c:v libx264 -qp 8 -pix_fmt yuv444p"
        frames = random.integers(0, 256, (8, 40, 48, 3)).astype(np.uint8)
        subprocess.run([*coding.split(), str(folder / "clip.mp4")], input=frames.tobytes(), check=True, timeout=60)
    return folder


class Written(list):
    """The arrays of all frames; shown as a number where a test fails."""

    def __repr__(self):
        return f"{len(self)} frames"


@pytest.fixture(scope="module")
def written():
    """What is handed over to be written: (path, combined, flow, matte), before half floats hide anything."""
    written, write = Written(), engine.write_frame

    def watch(path, combined, flow, matte, **how):
        written.append((combined, flow, matte, *(image for _, image in how["layers"])))
        write(path, combined, flow, matte, **how)

    engine.write_frame = watch
    yield written
    engine.write_frame = write


fluids = some.builds(
    lambda motion, matte, more: {
        "stillwater": 1, "picture": "picture.png", "frames": [1, 3], **more,
        "layers": [{"name": "fluid", "matte": matte, "fill": {"method": "none"}, "motion": motion}, {"name": "back"}],
    },
    some.one_of(flows, *([films] if shutil.which("ffmpeg") else [])), mattes,
    parts(fps=number(0.001, 1000, 24), loop=some.booleans(), output=parts(scale=some.sampled_from([0.001, 0.5, 1, 2.3]), layers=some.booleans())),
)  # fmt: skip
thorough = dict(derandomize=True, deadline=None, database=None, suppress_health_check=list(HealthCheck))


@settings(max_examples=60, **thorough)
@given(recipe=recipes)
def test_a_random_recipe_is_rendered_or_refused(pictures, written, recipe):
    rendered_or_refused(pictures, written, recipe)


@settings(max_examples=60, **thorough)
@given(recipe=fluids)
def test_a_random_fluid_is_rendered_or_refused(pictures, written, recipe):
    rendered_or_refused(pictures, written, recipe)


def rendered_or_refused(pictures, written, recipe):
    written.clear()
    with TemporaryDirectory() as name:
        folder = Path(name)
        for picture in pictures.iterdir():
            shutil.copy(picture, folder)
        try:
            list(render(parse(recipe, folder), Order()))
        except (RecipeError, Refused):
            assert not (folder / "frames").exists()
            return
        assert len(list((folder / "frames").iterdir())) == len(written) == 3
    for combined, flow, matte, *others in written:
        finite = [bool(np.isfinite(array).all()) for array in (combined, flow, matte, *others)]
        assert all(finite), finite
        ranges = [(float(array.min()), float(array.max())) for array in (combined[..., 3], matte)]
        # 1e-6: what sixteen rounded weights of an opaque pixel may add up to beyond 1.
        assert all(low >= 0 and high <= 1 + 1e-6 for low, high in ranges), ranges
