"""Fifty seeded sequences of all that an artist can do: operators, undo, files, scenes, sliders, and things deleted by hand.

After every step the file is whole, nothing of ours was raised, and the panels draw.
"""

import random
from pathlib import Path

import bpy
import clips
import invariants
import pytest
import recipes
from drawings import draw as stroke
from drawings import on_plane
from layered import key
from pictures import paint

SEEDS, STEPS = 50, 15
SLOW = 5  # every so-manieth sequence bakes, and plays its pictures live
MOTIONS = ["still", "sway", "ripple", "bob", "drift", "flow", "example"]
ROLES = ["sway_line", "waterline", "horizon", "horizon", "foreground", "background", "outline", "touch_up"]
ROLES += ["flow", "speed", "freeze", "clone_source", "clone_target"]


class Artist:
    """Someone at work in a folder, whose choices follow from a seed."""

    def __init__(self, extension, seed: int, folder: Path):
        self.extension, self.dice, self.folder = extension, random.Random(seed), folder
        self.bakes = seed % SLOW == 0
        self.saved = None

    def file(self, ending: str) -> str:
        return str(self.folder / f"{self.dice.choice('abc')}{ending}")

    def picture_file(self) -> str:
        sizes = [(24, 16), (16, 24), (32, 8)]
        path = self.folder / f"{self.dice.choice(['pond', 'lake', 'sea'])}.png"
        return str(paint(path, self.dice.choice(sizes)) if not path.exists() or self.dice.random() < 0.3 else path)

    def recipe_file(self) -> str:
        whole = recipes.whole()
        some = self.dice.sample(whole["layers"], self.dice.randrange(1, len(whole["layers"])))
        layers = [{**layer, "matte": {"file": "picture.png"}} for layer in some if layer["name"] in ("tree", "clouds")]
        whole |= {"frames": [1, 2], "layers": [*layers, {"name": "sky"}], "output": {"folder": "frames"}}
        return str(recipes.write(self.folder / "made", whole))

    def clip_file(self) -> str:
        path = self.folder / self.dice.choice(["fall.avi", "fire.avi", "gone.avi"])
        if path.stem != "gone" and not path.exists():
            clips.write(path, clips.passing((48, 32), frames=6))
        return str(path)

    def preset_file(self) -> str:
        files = self.extension.layers.preset_files
        return str(self.dice.choice([path for kind in files.KINDS for path in files.paths(kind)]))

    @property
    def picture(self):
        return bpy.context.scene.stillwater.active()


def one_of(name: str, values: list, **others):
    return lambda artist: {name: artist.dice.choice(values), **others}


def nothing(artist) -> dict:
    return {}


# Every operator of the extension, and its arguments. Those that only ask, or delete the artist's own files, are called
# as their button would once it is confirmed.
CALLS = {
    "add_layer": one_of("motion", MOTIONS),
    "add_node": nothing,
    "add_to_sequencer": nothing,
    "add_waterline_point": lambda artist: {"place": (artist.dice.uniform(0, 20), artist.dice.uniform(0, 20))},
    "apply_preset": lambda artist: {"filepath": artist.preset_file()},
    "bake": lambda artist: {"range": artist.dice.choice(["ALL", "CURRENT", "PREVIEW"]), "fresh": artist.dice.random() < 0.3},
    "cancel": nothing,
    "change_role": one_of("role", ROLES),
    "check_frames": nothing,
    "choose_clip": lambda artist: {"filepath": artist.clip_file()},
    "clear_unsaved": nothing,
    "clear_waterline": nothing,
    "collect": lambda artist: {"filepath": artist.file(".zip")},
    "copy_layers": nothing,
    "copy_to_selected": one_of("path", ["motion", "opacity", "motion.sway.amount", "name", "nothing.here"]),
    "delete_strokes": one_of("role", ROLES),
    "draw_clone_source": one_of("path", [[], [{"name": "", "loc": place, "time": 0.0} for place in ((4, 4), (40, 20))]]),
    "draw_stroke": one_of("role", ROLES),
    "drop_picture": lambda artist: {"filepath": artist.picture_file()},
    "duplicate_layer": nothing,
    "export_recipe": lambda artist: {"filepath": artist.file(".json")},
    "fit_view": nothing,
    "former_view": nothing,
    "free_bake": nothing,
    "layer_from_outline": one_of("motion", MOTIONS),
    "layers_from_mask": one_of("mask", ["", "Mask", "none"]),
    "layers_from_pass": lambda artist: {"filepath": artist.picture_file()},
    "load_recipe": lambda artist: {"filepath": artist.recipe_file()},
    "move_layer": one_of("direction", ["UP", "DOWN", "TOP", "BOTTOM"]),
    "open_picture": lambda artist: {"filepath": artist.picture_file(), "use_render": artist.dice.random() < 0.8},
    "paste_layers": nothing,
    "pick_speed": one_of("place", [(4, 4), (500, 3)]),
    "propose_flow": one_of("kind", ["water", "smoke"]),
    "refresh": nothing,
    "reload_picture": nothing,
    "remove_layer": nothing,
    "remove_picture": one_of("delete_files", [False, False, True]),
    "remove_preset": lambda artist: {"filepath": artist.preset_file()},
    "remove_waterline_point": one_of("index", [-1, 0, 5]),
    "replace_picture": lambda artist: {"filepath": artist.picture_file()},
    "save_preset": lambda artist: {"name": artist.dice.choice("pq"), "of": artist.dice.choice(["MOTION", "WIND"])},
    "set_flow": one_of("speed", [0, 3]),
    "select_layers": one_of("action", ["SELECT", "DESELECT", "INVERT", "MOTION"]),
    "set_motion": one_of("type", MOTIONS),
    "show_clip": nothing,
    "show_layers": one_of("visible", [True, False]),
    "show_picture": one_of("index", [-1, 0, 1, 7]),
    "standard_view": nothing,
    "stop_drawing": nothing,
    "try_python": nothing,
}
SLOWLY = {"bake", "try_python", "add_to_sequencer", "cancel"}  # these start a Python, or need a bake
OFTEN = ["open_picture", "add_layer", "add_layer", "draw_stroke", "duplicate_layer", "remove_picture", "show_picture"]


def operate(artist) -> str:
    """Calls one operator as its button does, where it can be called, mostly after what makes that so."""
    names = [*CALLS, *OFTEN]
    name = artist.dice.choice(names if artist.bakes else [name for name in names if name not in SLOWLY])
    call, arguments = getattr(bpy.ops.stillwater, name), CALLS[name](artist)
    if not call.poll() and name in FIRST and artist.dice.random() < 0.8:
        FIRST[name](artist)
        bpy.ops.ed.undo_push(message=f"before {name}")
    if call.poll():
        _call(call, **arguments)
    return f"{name} {arguments}"


def _call(call, **arguments) -> None:
    try:
        call("EXEC_DEFAULT", True, **arguments)
    except RuntimeError as error:  # what it reports
        assert str(error).startswith("Error: ") and "Traceback" not in str(error), error


def undo(artist) -> None:
    if bpy.ops.ed.undo.poll():
        bpy.ops.ed.undo()


def redo(artist) -> None:
    if bpy.ops.ed.redo.poll():
        bpy.ops.ed.redo()


def save(artist) -> None:
    artist.saved = str(artist.folder / artist.dice.choice(["one.blend", "two.blend"]))
    bpy.ops.wm.save_as_mainfile(filepath=artist.saved)


def load(artist) -> None:
    if artist.saved:
        bpy.ops.wm.open_mainfile(filepath=artist.saved)


def another_frame(artist) -> None:
    bpy.context.scene.frame_set(artist.dice.randrange(-1, 6))


def another_scene(artist) -> None:
    bpy.ops.scene.new(type=artist.dice.choice(["FULL_COPY", "LINK_COPY", "EMPTY", "NEW"]))
    if len(bpy.context.scene.stillwater.pictures) == 0:
        bpy.context.scene.frame_end = 2


def other_scene(artist) -> None:
    bpy.context.window.scene = artist.dice.choice(list(bpy.data.scenes))


def delete_scene(artist) -> None:
    if bpy.ops.scene.delete.poll():
        bpy.ops.scene.delete()


def rename(artist) -> None:
    picture = artist.picture
    if picture is not None:
        picture.name = artist.dice.choice(["Lake", "", "lake", "x/y", "Ü" * 80])
        for layer in picture.layers[:1]:
            layer.name = artist.dice.choice(["Oak", "", "sky", "a" * 80])


def slide(artist) -> None:
    """Sliders, and choices in the panels."""
    picture = artist.picture
    if picture is None:
        return
    picture.wind.speed, picture.loop = artist.dice.uniform(0, 30), artist.dice.random() < 0.5
    picture.view.use_horizon = artist.dice.random() < 0.5
    picture.view.horizon_end = artist.dice.uniform(1, 20), 4
    bpy.context.scene.stillwater_live.view = artist.dice.choice(["picture", "layer", "matte", "behind", "original"])
    if len(picture.layers):
        layer = artist.dice.choice(list(picture.layers))
        layer.opacity, layer.selected, layer.solo = artist.dice.random(), True, artist.dice.random() < 0.2
        layer.motion.sway.armature_tip = artist.dice.uniform(0, 20), 1
        layer.matte.form = artist.dice.choice(["none", "file", "labels", "scribbles", "lasso", "trimap"])
        layer.fill.source.form = artist.dice.choice(["none", "none", "none", "lasso", "scribbles"])
        layer.matte.file = artist.picture_file()
        layer.follows.layer = artist.dice.choice([other.name for other in picture.layers])
        picture.active_layer = artist.dice.randrange(len(picture.layers))


def animate(artist) -> None:
    picture = artist.picture
    if picture is not None and len(picture.layers):
        layer = artist.dice.choice(list(picture.layers))
        key(artist.extension, f"{layer.path_from_id()}.opacity", (1, 0.2), (4, 0.9))
        bpy.context.scene.driver_add(f"{picture.path_from_id()}.wind.speed").driver.expression = "3 + frame / 10"


def draw_by_hand(artist) -> None:
    """A stroke on whatever is drawn on, and into edit mode with it."""
    picture = artist.picture
    data = artist.extension.strokes.gp_layers.data_of(picture) if picture is not None else None
    if data is None or not len(data.layers):
        return
    part = data.layers.active or data.layers[0]
    stroke(part, on_plane((600, 400), (650, 380)), frame=bpy.context.scene.frame_start)
    if artist.dice.random() < 0.5 and picture.strokes.name in bpy.context.view_layer.objects:
        bpy.context.view_layer.objects.active = picture.strokes
        if bpy.ops.object.mode_set.poll():
            bpy.ops.object.mode_set(mode=artist.dice.choice(["EDIT", "OBJECT"]))


def delete_by_hand(artist) -> None:
    """Something that we made, as if we had never been there."""
    picture = artist.picture
    if picture is None:
        return
    kinds = {
        "plane": bpy.data.objects, "camera": bpy.data.objects, "strokes": bpy.data.objects,
        "collection": bpy.data.collections, "tree": bpy.data.node_groups, "image": bpy.data.images,
    }  # fmt: skip
    kind = artist.dice.choice(list(kinds))
    if getattr(picture, kind) is not None:
        kinds[kind].remove(getattr(picture, kind))


def begin_a_bake(artist) -> None:
    """It goes on while other things are done."""
    job, scene = artist.extension.bake.job, bpy.context.scene
    if artist.bakes and artist.picture is not None:
        scene.frame_start, scene.frame_end = 1, 2
        try:
            job.start(scene, artist.picture)
        except (ValueError, OSError) as error:
            assert str(error)


def float_a_boat(artist) -> None:
    if artist.picture is not None and len(artist.picture.layers):
        artist.picture.layers[artist.picture.active_layer].motion.type = "bob"
        artist.picture.layers[artist.picture.active_layer].motion.bob.waterline.add()


def select_strokes(artist) -> None:
    """In edit mode, all of them."""
    draw_a_horizon(artist)
    draw_by_hand(artist)
    if bpy.context.mode == "PAINT_GREASE_PENCIL":
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.grease_pencil.select_all(action="SELECT")


def draw_a_horizon(artist) -> None:
    if bpy.ops.stillwater.draw_stroke.poll():
        _call(bpy.ops.stillwater.draw_stroke, role="horizon")


def make_a_mask(artist) -> None:
    spline = bpy.data.masks.new("Mask").layers.new(name="oak").splines.new()
    spline.points.add(3)
    for point, place in zip(spline.points, ((0.2, 0.3), (0.8, 0.3), (0.8, 0.7), (0.2, 0.7)), strict=True):
        point.co = point.handle_left = point.handle_right = place
    spline.use_cyclic = True


def select_two(artist) -> None:
    if artist.picture is not None:
        artist.extension.properties.arrange.add_layer(artist.picture, "one more").selected = True


def use_agx(artist) -> None:
    bpy.context.scene.view_settings.view_transform = "AgX"


def use_standard_after_agx(artist) -> None:
    use_agx(artist)
    _call(bpy.ops.stillwater.standard_view)


def bake_first(artist) -> None:
    if bpy.ops.stillwater.bake.poll():
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 2
        _call(bpy.ops.stillwater.bake)


# What makes an operator possible.
FIRST = {
    "add_to_sequencer": bake_first, "add_waterline_point": float_a_boat, "cancel": begin_a_bake,
    "change_role": select_strokes, "clear_waterline": float_a_boat, "copy_to_selected": select_two,
    "former_view": use_standard_after_agx, "layers_from_mask": make_a_mask, "remove_waterline_point": float_a_boat,
    "standard_view": use_agx, "stop_drawing": draw_a_horizon,
}  # fmt: skip
PUSHED = [another_scene, delete_scene, rename, slide, slide, animate, draw_by_hand, delete_by_hand]  # steps to be undone
OTHERS = [undo, undo, redo, save, load, another_frame, other_scene, begin_a_bake]


def do_something(artist) -> str:
    if artist.dice.random() < 0.55:
        return operate(artist)
    step = artist.dice.choice([*PUSHED, *OTHERS])
    step(artist)
    if step in PUSHED:
        bpy.ops.ed.undo_push(message=step.__name__)
    return step.__name__


def test_every_operator_is_among_them(scene):
    assert set(dir(bpy.ops.stillwater)) == set(CALLS)


@pytest.fixture
def artist(extension, scene, tmp_path, request, monkeypatch):
    seed = request.param
    monkeypatch.setattr(extension.play.show, "seen", seed % SLOW < 2)
    scene.frame_start, scene.frame_end = 1, 2
    yield Artist(extension, seed, tmp_path)
    extension.bake.job.end_all()
    extension.play.server.end()
    extension.play.show.forget()


@pytest.mark.parametrize("artist", range(SEEDS), indirect=True)
def test_whatever_is_done_the_file_is_whole(extension, artist, capfd):
    bpy.ops.stillwater.open_picture("EXEC_DEFAULT", True, filepath=artist.picture_file())
    done = []
    for _ in range(STEPS):
        done.append(do_something(artist))
        extension.bake.job.tick()
        extension.play.server.tick()
        extension.strokes.draw_mode.tick()
        extension.bake.outdated.tick()
        try:
            for scene in bpy.data.scenes:
                invariants.of_scene(extension, scene)
            invariants.of_panels()
            said = "".join(capfd.readouterr())
            assert "Traceback" not in said, said
        except Exception as error:
            error.add_note("after " + "\n      ".join(done))
            raise
