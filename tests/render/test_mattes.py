"""Mattes that are drawn, and holes that are filled from patches, in a recipe: solved on what is left, redone where they
change, and refused with a sentence."""

import numpy as np
import pytest
from PIL import Image
from stillwater import RecipeError, load
from stillwater import _stillwater as engine
from stillwater.render.cache import FOLDER, Cache
from stillwater.render.events import QuickMatte
from stillwater.render.prepare import Sources
from stillwater.render.quick_matte import Pictures, quick_matte
from stillwater.render.stack import layers_of

TREE, BACK = 0, 1
FOREGROUND = [{"points": [[24, 12], [24, 20]], "width": 6}]
BACKGROUND = [{"points": [[3, 3], [45, 3], [45, 33], [3, 33]], "width": 4}]


@pytest.fixture
def disc(tmp_path):
    """A red disc before blue and green stripes: `disc(matte, **fill)` writes a recipe that cuts it out."""
    y, x = np.mgrid[:36, :48]
    picture = np.zeros((36, 48, 3))
    picture[..., 2] = np.where(x // 4 % 2, 0.9, 0.5)
    picture[..., 1] = 0.6 * y / 36
    true = np.clip(9.5 - np.hypot(x - 23.5, y - 15.5), 0, 1)
    picture += true[..., None] * (np.array([1.0, 0.1, 0.1]) - picture)
    Image.fromarray(np.round(255 * picture).astype(np.uint8)).save(tmp_path / "picture.png")
    Image.fromarray(np.where(true == 1, 255, np.where(np.hypot(x - 23.5, y - 15.5) > 12, 0, 128)).astype(np.uint8)).save(
        tmp_path / "trimap.png"
    )

    def write(scene, matte, **layer):
        layers = [{"name": "disc", "matte": matte, **layer}, {"name": "back"}]
        return scene(lambda recipe: recipe.update(layers=layers, loop=False), "disc.json")

    return write, true


def stack_of(path):
    document = load(path)
    cache = Cache(path.parent / FOLDER)
    work = layers_of(Sources(document, cache), cache, lambda: None)
    while True:
        try:
            next(work)
        except StopIteration as end:
            return end.value


def plane(stack, index, shape=(36, 48)):
    whole = np.zeros((*shape, 4), np.float32)
    x, y, width, height = stack.facts["colour"][index]
    whole[y : y + height, x : x + width] = stack.arrays[f"colour{index}"]
    return whole


FORMS = {
    "trimap": {"trimap": "trimap.png"},
    "scribbles": {"scribbles": {"foreground": FOREGROUND, "background": BACKGROUND}},
    "lasso": {"lasso": [[24 + 10 * np.cos(a), 16 + 10 * np.sin(a)] for a in np.linspace(0, 6, 12)], "feather": 3},
    "snapped": {"lasso": [[24 + 12 * np.cos(a), 16 + 12 * np.sin(a)] for a in np.linspace(0, 6, 12)], "feather": 2, "snap": 5},
}


@pytest.mark.parametrize("form", FORMS)
def test_each_form_cuts_the_disc_out(scene, disc, form):
    write, true = disc
    stack = stack_of(write(scene, FORMS[form]))
    layer = plane(stack, TREE)
    assert abs(layer[..., 3] - true).mean() < 0.01
    inside = layer[..., 3] > 0.5
    off = abs(layer[inside][:, :3] / layer[inside][:, 3:] - [1, 0.1, 0.1])
    assert off.mean() < 0.02 and off.max() < 0.1
    picture = engine.read_picture(str(write(scene, FORMS[form]).parent / "picture.png")).image
    back = plane(stack, BACK)
    np.testing.assert_allclose(layer + (1 - layer[..., 3:]) * back, picture, atol=1e-5)
    assert back[inside][:, 0].max() < 0.2  # nothing of the disc is left behind


def test_a_matte_is_solved_on_what_is_left(scene, tmp_path, disc):
    """The left half goes on behind the disc, and has its own colours there."""
    write, true = disc
    path = write(scene, FORMS["trimap"])
    half = {"lasso": [[-5, -5], [28, -5], [28, 40], [-5, 40]], "feather": 2}

    def both(recipe):
        fill = {"method": "none"}
        recipe["layers"] = [{"name": "disc", "matte": FORMS["trimap"], "fill": {"method": "exemplar", "patch": 5}},
                            {"name": "half", "matte": half, "fill": fill}, {"name": "back"}]  # fmt: skip

    behind = plane(stack_of(scene(both, path.name)), 1)
    hidden = (true == 1) & (np.mgrid[:36, :48][1] < 25)
    assert behind[hidden][:, 3].min() > 0.9 and behind[hidden][:, 0].max() < 0.2


FILL = {"method": "exemplar", "patch": 5}
FIELDS = {
    "patch": 7,
    "radius": 24,
    "grow": 5,
    "source": {"labels": "half.png", "value": 1},
    "touch_up": [{"stroke": {"points": [[24, 10], [24, 20]], "width": 8}, "radius": 24, "seed": 5}],
}


@pytest.mark.parametrize("field", FIELDS)
def test_each_field_of_a_filling_changes_what_lies_behind(scene, disc, tmp_path, field):
    write, true = disc
    noise = np.random.default_rng(1).integers(0, 255, (36, 48, 3)).astype(np.uint8)
    Image.fromarray(noise).save(tmp_path / "picture.png")
    Image.fromarray((np.mgrid[:36, :48][1] > 24).astype(np.uint8)).save(tmp_path / "half.png")
    Image.fromarray(np.round(255 * true).astype(np.uint8)).save(tmp_path / "disc.png")
    before = plane(stack_of(write(scene, {"file": "disc.png"}, fill=FILL)), BACK)
    after = plane(stack_of(write(scene, {"file": "disc.png"}, fill={**FILL, field: FIELDS[field]})), BACK)
    assert not np.array_equal(before, after)
    np.testing.assert_array_equal(before[true == 0], after[true == 0])


def test_patches_come_from_the_source(scene, disc, tmp_path):
    write, true = disc
    y, x = np.mgrid[:36, :48]
    Image.fromarray((x > 36).astype(np.uint8)).save(tmp_path / "half.png")
    picture = np.zeros((36, 48, 3), np.uint8)
    picture[..., 0] = np.where(x > 36, 200, 40)
    Image.fromarray(picture).save(tmp_path / "picture.png")
    fill = {"method": "exemplar", "patch": 5, "source": {"labels": "half.png", "value": 1}, "grow": 0}
    back = plane(stack_of(write(scene, {"file": "trimap.png"}, fill=fill)), BACK)
    inner = np.hypot(x - 23.5, y - 15.5) < 3
    assert (abs(back[..., 0] - 40 / 255) > 1e-3)[inner].any()


@pytest.mark.parametrize(
    "matte, fill, sentence",
    [
        ({"scribbles": {"foreground": FOREGROUND}}, {}, r"layers\[0\].matte.scribbles.background: no stroke is not one stroke"),
        ({"scribbles": {"background": BACKGROUND}}, {}, r"layers\[0\].matte.scribbles.foreground: no stroke is not one stroke"),
        ({"scribbles": {"foreground": FOREGROUND, "background": FOREGROUND}}, {},
         r"layers\[0\].matte.scribbles: foreground\[0\] and background\[0\]"),
        ({"lasso": [[100, 100], [120, 100], [120, 120]]}, {}, r"layers\[0\].matte.lasso: no pixel of the picture is inside"),
        ({"trimap": "grey.png"}, {}, r"layers\[0\].matte: no pixel of its trimap is foreground"),
        ({"trimap": "gone.png"}, {}, r"layers\[0\].matte.trimap: .*gone.png: there is no such file"),
        ({"trimap": "small.png"}, {}, r"layers\[0\].matte.trimap: small.png: 5 x 4 is not the size of the picture, 48 x 36"),
        ({"trimap": "trimap.png"}, {"fill": {"method": "exemplar", "source": {"trimap": "grey.png"}}},
         r"layers\[0\].fill.source: no pixel of its trimap is foreground"),
        ({"trimap": "trimap.png"}, {"fill": {"method": "exemplar", "source": {"file": "gone.png"}}},
         r"layers\[0\].fill.source.file: .*gone.png: there is no such file"),
        ({"trimap": "trimap.png"}, {"fill": {"method": "exemplar", "radius": 0.5}}, r"layers\[0\].fill: "),
    ],
)  # fmt: skip
def test_what_can_t_be_cut_is_a_sentence(scene, disc, tmp_path, matte, fill, sentence):
    write, _ = disc
    Image.fromarray(np.full((36, 48), 128, np.uint8)).save(tmp_path / "grey.png")
    Image.fromarray(np.zeros((4, 5), np.uint8)).save(tmp_path / "small.png")
    with pytest.raises(RecipeError, match=sentence):
        stack_of(write(scene, matte, **fill))


class TestQuickMatte:
    """Of one layer, while it is drawn."""

    @staticmethod
    def ask(path, name="disc", pictures=None):
        document = load(path)
        cache = Cache(path.parent / FOLDER)
        *_, event = quick_matte(document, name, cache, pictures or Pictures())
        assert isinstance(event, QuickMatte) and event.layer == name
        return cache.find(event.key).arrays["matte"]

    @pytest.mark.parametrize("form", [*FORMS, "file"])
    def test_it_is_near_to_the_final_one(self, scene, disc, form):
        path = disc[0](scene, FORMS.get(form, {"file": "trimap.png"}))
        quick = self.ask(path)
        assert quick.dtype == np.uint8 and quick.shape == (36, 48)
        np.testing.assert_allclose(quick / 255, plane(stack_of(path), TREE)[..., 3], atol=0.03)

    def test_it_is_solved_smaller_where_much_is_unknown(self, scene, disc, monkeypatch):
        path = disc[0](scene, FORMS["scribbles"])
        exact = self.ask(path)
        monkeypatch.setattr("stillwater.render.quick_matte.AT_ONCE", 300)
        smaller = self.ask(path)
        assert not np.array_equal(exact, smaller) and abs(exact / 255 - smaller / 255).mean() < 0.03

    def test_it_is_solved_on_what_is_left(self, scene, disc):
        def both(recipe):
            recipe["layers"] = [{"name": "disc", "matte": FORMS["trimap"], "fill": {"method": "exemplar", "patch": 5}},
                                {"name": "second", "matte": FORMS["scribbles"]}, {"name": "back"}]  # fmt: skip

        path = scene(both, disc[0](scene, FORMS["trimap"]).name)
        on_the_picture = self.ask(path, "second")
        for key in Cache(path.parent / FOLDER).facts():
            Cache(path.parent / FOLDER).forget(key)
        stack_of(scene(lambda recipe: recipe.update(layers=[
            {"name": "disc", "matte": FORMS["trimap"], "fill": {"method": "exemplar", "patch": 5}}, {"name": "back"}]), "front.json"))  # fmt: skip
        assert not np.array_equal(self.ask(path, "second"), on_the_picture)

    def test_the_picture_is_read_once(self, scene, disc, monkeypatch):
        path, pictures = disc[0](scene, FORMS["scribbles"]), Pictures()
        self.ask(path, pictures=pictures)
        monkeypatch.setattr(engine, "read_picture", None)
        self.ask(disc[0](scene, FORMS["lasso"]), pictures=pictures)

    def test_what_is_wrong_is_a_sentence(self, scene, disc):
        path = disc[0](scene, FORMS["scribbles"])
        with pytest.raises(RecipeError, match='layer: "tree" is not one of disc, back'):
            self.ask(path, "tree")
        with pytest.raises(RecipeError, match=r"layers\[1\].matte: missing \(there is nothing to solve\)"):
            self.ask(path, "back")
