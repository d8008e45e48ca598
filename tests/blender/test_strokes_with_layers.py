"""What was drawn for a layer stays with it: in its sentences, when it is duplicated, removed, copied."""

import importlib

import bpy
import pytest
from drawings import draw, lay_out, on_plane
from layered import said
from pixels import PACKAGE

strokes = importlib.import_module(f"{PACKAGE}.strokes")
gp_layers = importlib.import_module(f"{PACKAGE}.strokes.gp_layers")
roles = importlib.import_module(f"{PACKAGE}.strokes.roles")
missing = importlib.import_module(f"{PACKAGE}.layers.missing")
SWAY_LINE, HORIZON = roles.by_key("sway_line"), roles.by_key("horizon")
LINE = [[640, 700], [600, 100]]  # px


@pytest.fixture
def tree(extension, scene, picture):
    """A swaying layer whose sway line is drawn."""
    lay_out(scene, picture)
    layer = picture.layers[0]
    layer.motion.type = "sway"
    draw(gp_layers.ensure(picture, layer.id, SWAY_LINE), on_plane(*LINE))
    return layer


def lines(extension) -> dict[str, list]:
    """The armatures that the recipe has, by their layers' names, in whole pixels."""
    found = {}
    for layer in said(extension)["layers"]:
        found[layer["name"]] = [[round(value) for value in point] for point in layer["motion"]["armature"]]
    return found


def test_what_is_drawn_is_not_missed(scene, picture, tree):
    drawn = strokes.replaced(scene, picture, tree)
    assert drawn == {"armature_root", "armature_tip"}
    assert missing.of(picture, 0, drawn) == []
    assert missing.of(picture, 0, set()) == ["Draw its sway line, from where it is held to its tip"]


def test_a_drawn_horizon_counts_for_every_layer(scene, picture, tree):
    draw(gp_layers.ensure(picture, "", HORIZON), on_plane((0, 300), (1280, 310)))
    tree.motion.type = "ripple"
    assert missing.of(picture, 0, strokes.replaced(scene, picture, tree)) == []
    assert missing.of(picture, 0, set()) == ["Draw the horizon, or turn it on in View"]


def test_a_duplicated_layer_has_strokes_of_its_own(extension, picture, tree):
    bpy.ops.stillwater.duplicate_layer()
    assert lines(extension) == {"all": LINE, "all.001": LINE}
    copied = next(layer for layer in picture.layers if layer.name == "all.001")
    assert len(gp_layers.of(picture, copied.id, SWAY_LINE)) == 1


def test_a_removed_layer_leaves_no_strokes(picture, tree):
    identifier = tree.id
    bpy.ops.stillwater.remove_layer()
    assert gp_layers.of(picture, identifier, SWAY_LINE) == []


def test_a_copied_layer_brings_its_line_as_numbers(extension, scene, picture, tree):
    bpy.ops.stillwater.copy_layers()
    other = extension.properties.arrange.add_picture(scene, "Pond")
    bpy.ops.stillwater.paste_layers()
    sway = other.layers[0].motion.sway
    assert [[round(value) for value in end] for end in (sway.armature_root, sway.armature_tip)] == LINE
