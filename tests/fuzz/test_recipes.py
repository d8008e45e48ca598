"""Random recipes, from the middle to the ends of every range: rendered or refused, never a crash, never a NaN."""

import shutil
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
line = some.tuples(place, place).map(list)
seed = some.integers(0, 2**53)

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


@settings(max_examples=60, derandomize=True, deadline=None, database=None, suppress_health_check=list(HealthCheck))
@given(recipe=recipes)
def test_a_random_recipe_is_rendered_or_refused(pictures, written, recipe):
    written.clear()
    with TemporaryDirectory() as name:
        folder = Path(name)
        for picture in pictures.glob("*.png"):
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
