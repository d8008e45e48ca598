"""Strokes that cut a layer out: which layers have them, what their buttons begin, and how they are drawn."""

import importlib
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from drawings import draw, lay_out, on_plane
from layered import said
from panels import Recorder, registered
from panels import draw as show
from pixels import PACKAGE

draw_mode = importlib.import_module(f"{PACKAGE}.strokes.draw_mode")
gp_layers = importlib.import_module(f"{PACKAGE}.strokes.gp_layers")
missing = importlib.import_module(f"{PACKAGE}.layers.missing")
roles = importlib.import_module(f"{PACKAGE}.strokes.roles")
CUTTING = [role for role in roles.ROLES if role.of]


@pytest.fixture
def layers(scene, picture, extension):
    """Oak, which is active and cut out by nothing yet, before sky."""
    lay_out(scene, picture)
    picture.layers[0].name = "Oak"
    extension.properties.arrange.add_layer(picture, "sky")
    picture.active_layer = 0
    return picture.layers


def offered() -> list[str]:
    """The roles whose buttons the panel shows."""
    shown = show(next(cls for cls in registered("view_3d") if cls.bl_label == "Strokes"))
    buttons = zip(shown.operators, shown.made, strict=True)
    return [made.role for name, made in buttons if name == "stillwater.draw_stroke"]


def make(layer, role) -> None:
    """Gives a layer what the role is of."""
    what, _, form = role.of.partition(".")
    group = {"matte": layer.matte, "source": layer.fill.source}.get(what)
    layer.matte.form = "file" if what != "matte" else form
    if group is not None:
        group.form = form


@pytest.mark.parametrize("role", CUTTING, ids=lambda role: role.key)
def test_its_button_leads_into_draw_mode(scene, picture, layers, role):
    make(layers[0], role)
    assert role.key in offered()
    assert bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role=role.key) == {"FINISHED"}
    part = picture.strokes.data.layers.active
    assert bpy.context.mode == "PAINT_GREASE_PENCIL" and part.name == f"Oak · {role.name}"
    assert picture.strokes.active_material.name == f"Stillwater {role.name}"
    assert draw_mode.hint(scene) == f"{role.name} of Oak: {role.hint}"
    assert bpy.ops.stillwater.stop_drawing("EXEC_DEFAULT", True) == {"FINISHED"}
    draw(part, on_plane((100, 100), (400, 100), (400, 300)), frame=part.frames[0].frame_number)
    said_now = roles.of_layer(layers[0])
    assert role in said_now and role.replaces[0] in strokes_of(scene, picture, layers[0])
    assert bpy.ops.stillwater.delete_strokes("EXEC_DEFAULT", True, role=role.key) == {"FINISHED"}
    assert role.replaces[0] not in strokes_of(scene, picture, layers[0])


def strokes_of(scene, picture, layer) -> set[str]:
    return importlib.import_module(f"{PACKAGE}.strokes").replaced(scene, picture, layer)


def test_a_layer_without_a_matte_offers_what_would_cut_it_out(picture, layers):
    assert offered() == ["foreground", "background", "outline", "horizon"]
    layers[0].matte.form = "file"  # whose file is not chosen yet
    assert set(offered()) == {"foreground", "background", "outline", "touch_up", "horizon"}
    layers[0].matte.file = "//oak.png"
    assert offered() == ["touch_up", "horizon"] or set(offered()) == {"touch_up", "horizon"}
    layers[0].matte.form = "lasso"
    assert set(offered()) == {"outline", "touch_up", "horizon"}
    layers[0].fill.method = "none"
    assert set(offered()) == {"outline", "horizon"}
    picture.active_layer = 1  # the last one needs no matte
    assert offered() == ["horizon"]


@pytest.mark.parametrize("key, form", [("foreground", "scribbles"), ("background", "scribbles"), ("outline", "lasso")])
def test_drawing_at_once_chooses_the_matte(picture, layers, key, form):
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role=key)
    assert picture.layers[0].matte.form == form
    bpy.ops.ed.undo()
    assert bpy.context.scene.stillwater.active().layers[0].matte.form == "none"


REFUSED = {
    "foreground": "Oak: only a layer whose Matte is Scribbles has a Foreground",
    "outline": "Oak: only a layer whose Matte is Outline has a Outline",
    "touch_up": "Oak: only a layer whose Fill is Exemplar has a Touch-Up",
    "source_outline": "Oak: only a layer whose Fill is Exemplar has a Source Outline",
}


@pytest.mark.parametrize("key", REFUSED)
@pytest.mark.parametrize("operator", ["draw_stroke", "delete_strokes"])
def test_another_matte_is_not_drawn_on(picture, layers, key, operator):
    layers[0].matte.form, layers[0].matte.file, layers[0].fill.method = "file", "//oak.png", "none"
    with pytest.raises(RuntimeError, match=REFUSED[key]):
        getattr(bpy.ops.stillwater, operator)(role=key)
    assert layers[0].matte.form == "file"


def test_a_source_that_is_not_drawn_is_not_drawn_on(picture, layers):
    with pytest.raises(RuntimeError, match="Oak: only a layer whose Source is Scribbles has a Source Foreground"):
        bpy.ops.stillwater.draw_stroke(role="source_foreground")


def test_pressure_is_the_width_of_a_scribble(extension, scene, picture, layers):
    layers[0].matte.form = "scribbles"
    for key, radii in (("foreground", [0.05, 0.1]), ("background", [0.025])):
        part = gp_layers.ensure(picture, layers[0].id, roles.by_key(key))
        draw(part, on_plane((100, 100), (400, 100))[: len(radii)], frame=scene.frame_start, radius=radii)
    matte = said(extension)["layers"][0]["matte"]
    assert matte == {
        "scribbles": {
            "foreground": [{"points": [[100, 100, 0.5], [400, 100, 1]], "width": 32}],
            "background": [{"points": [[100, 100]], "width": 8}],  # a dab counts
        },
        "method": "closed-form",
    }  # fmt: skip


def test_an_outline_takes_one_stroke(extension, scene, picture, layers):
    bpy.ops.stillwater.draw_stroke(role="outline")
    part = picture.strokes.data.layers.active
    for shift in (0, 50):
        ring = on_plane(*[(200 + shift + x, 200 + y) for x, y in ((0, 0), (90, 0), (90, 80))])
        draw(part, ring, frame=part.frames[0].frame_number)
    bpy.ops.stillwater.stop_drawing()
    assert len(part.frames[0].drawing.curve_offsets) == 2
    matte = said(extension)["layers"][0]["matte"]
    np.testing.assert_allclose(matte["lasso"], [[250, 200], [340, 200], [340, 280]], atol=0.01)
    assert (matte["feather"], matte["snap"]) == (8, 0)


SENTENCES = {
    ("matte", "scribbles"): ["Press Foreground and draw on what is part of it"],
    ("matte", "lasso"): ["Press Outline and draw once around it"],
    ("matte", "trimap"): ["Choose the file of its trimap"],
    ("matte", "labels"): ["Choose the file of its matte"],
    ("source", "file"): ["Choose the file that says what the hole behind it is filled with"],
    ("source", "scribbles"): ["Press Source Foreground and draw on what the hole behind it may be filled with"],
    ("source", "lasso"): ["Press Source Outline and draw around what the hole behind it may be filled with"],
}


@pytest.mark.parametrize("what, form", SENTENCES)
def test_what_must_be_drawn_is_said(picture, layers, what, form):
    layers[0].matte.form, layers[0].matte.file = "file", "//oak.png"
    (layers[0].matte if what == "matte" else layers[0].fill.source).form = form
    assert missing.of(picture, 0, set()) == SENTENCES[what, form]


def test_after_the_first_kind_the_other_is_asked_for(picture, layers):
    layers[0].matte.form = "scribbles"
    assert missing.of(picture, 0, {"foreground"}) == ["Press Background and draw beside it, on what is not part of it"]
    assert missing.of(picture, 0, {"foreground", "background"}) == []
    layers[0].matte.form, layers[0].fill.source.form = "lasso", "scribbles"
    (sentence,) = missing.of(picture, 0, {"outline", "source_foreground"})
    assert sentence.startswith("Press Source Background")


FORMS = {
    "file": {"file", "channel"}, "labels": {"labels", "value"}, "trimap": {"trimap"},
    "scribbles": set(), "lasso": {"snap"},
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_the_panel_shows_what_a_form_needs(picture, layers, form):
    panel = next(cls for cls in registered("view_3d") if cls.bl_label == "Layer")
    layers[0].matte.form = layers[0].fill.source.form = form
    shown = show(panel).properties
    assert all(shown.count(name) == 2 for name in FORMS[form])
    assert {"patch", "radius", "grow", "touch_up_radius", "touch_up_seed"} <= set(shown)
    assert shown.count("method") == 1 + 2 * (form in ("trimap", "scribbles", "lasso"))  # the fill's, and each matte's
    layers[0].fill.method = "file"
    assert not {"patch", "radius", "touch_up_seed"} & set(show(panel).properties)


def test_strokes_change_between_roles_of_a_matte(scene, picture, layers):
    layers[0].matte.form = "scribbles"
    part = gp_layers.ensure(picture, layers[0].id, roles.by_key("foreground"))
    draw(part, on_plane((100, 100), (400, 100)), frame=scene.frame_start, **{".selection": [True]})
    bpy.context.view_layer.objects.active = picture.strokes
    bpy.ops.object.mode_set(mode="EDIT")
    scene.frame_set(scene.frame_start)
    assert bpy.ops.stillwater.change_role("EXEC_DEFAULT", True, role="background") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert strokes_of(scene, picture, layers[0]) == {"background"}


def test_while_the_pen_is_down_nothing_is_asked(extension, scene, picture, layers, monkeypatch):
    handlers, shown = extension.play.handlers, []
    monkeypatch.setattr(extension.play.show, "scene", lambda *given: shown.append(given))
    monkeypatch.setattr(handlers.draw_mode, "pen_is_down", lambda: True)
    changed = SimpleNamespace(mode="VIEWPORT", updates=[SimpleNamespace(id=SimpleNamespace(original=picture.strokes))])
    handlers.something_changed(scene, changed)
    assert shown == [] and bpy.app.timers.is_registered(handlers.pen_lifted)
    assert handlers.pen_lifted() == handlers.LIFTED and shown == []
    monkeypatch.setattr(handlers.draw_mode, "pen_is_down", lambda: False)
    assert handlers.pen_lifted() is None and len(shown) == 1
    assert handlers.pen_lifted() is None and len(shown) == 1  # once
    bpy.app.timers.unregister(handlers.pen_lifted)


def test_the_menus_offer_new_layers(extension, scene):
    menu = Recorder()
    bpy.types.STILLWATER_MT_layer_from_outline.draw(SimpleNamespace(layout=menu), bpy.context)
    assert {"Tree", "Lake", "Boat", "Clouds", "Still"} <= set(menu.texts)
    assert {made.motion for made in menu.made} == {"sway", "ripple", "bob", "drift", "flow", "example", "still"}


def test_strokes_that_cut_out_are_faint_unless_their_layer_is_drawn_on(scene, picture, layers):
    for layer in layers:
        layer.matte.form = "scribbles"
        for key in ("foreground", "background"):
            gp_layers.ensure(picture, layer.id, roles.by_key(key))
    layers[0].motion.type = "sway"
    line = gp_layers.ensure(picture, layers[0].id, roles.by_key("sway_line"))

    def opaque() -> set[str]:
        return {part.name for part in picture.strokes.data.layers if part.opacity == 1} - {line.name}

    bpy.ops.stillwater.draw_stroke(role="foreground")
    assert opaque() == {"Oak · Foreground", "Oak · Background"}
    bpy.ops.stillwater.draw_stroke(role="background", layer="sky")
    assert opaque() == {"sky · Foreground", "sky · Background"}
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    assert opaque() == set()
    bpy.ops.stillwater.draw_stroke(role="background")
    bpy.ops.object.mode_set(mode="OBJECT")  # left by Blender's own way
    draw_mode.tick()
    assert opaque() == set() and line.opacity == 1


def test_touching_up_shows_what_is_behind(scene, picture, layers):
    layers[0].matte.form = "scribbles"
    bpy.ops.stillwater.draw_stroke(role="foreground")
    assert scene.stillwater_live.view == "picture"
    bpy.ops.stillwater.draw_stroke(role="touch_up")
    assert scene.stillwater_live.view == "behind"
