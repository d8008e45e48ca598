"""What holds after any step, whatever an artist does: said about the whole file."""

import re

import bpy
from layered import keyed
from panels import draw, registered


def of_layers(extension, picture) -> None:
    """Ids and names are unique, the active layer exists, every curve moves a layer that is there."""
    assert len({layer.id for layer in picture.layers}) == len(picture.layers)
    assert len({layer.name for layer in picture.layers}) == len(picture.layers)
    assert picture.active_layer < max(1, len(picture.layers))
    scene = picture.id_data
    drivers = scene.animation_data.drivers if scene.animation_data else ()
    for curve in [*keyed(extension, scene), *drivers]:
        scene.path_resolve(curve.data_path)
    for curve in drivers:
        for variable in curve.driver.variables:
            path = variable.targets[0].data_path
            assert path == "" or variable.targets[0].id.path_resolve(path) is not None


def of_scene(extension, scene) -> None:
    """Of its pictures, their recipes and their nodes."""
    pictures = scene.stillwater.pictures
    assert scene.stillwater.active_picture < max(1, len(pictures))
    assert len({picture.id for picture in pictures}) == len({picture.name for picture in pictures}) == len(pictures)
    for picture in pictures:
        of_layers(extension, picture)
        _of_recipe(extension, scene, picture)
        _of_tree(picture)
        stage = extension.play.show.stage_of(scene, picture)
        assert stage is None or not re.match(r"\w+(Error|Exception): ", stage.problem), stage.problem
    _of_nodes(extension, scene)


def of_panels() -> None:
    """All that can be drawn draws."""
    for panel in [*registered("view_3d"), *registered("node_editor")]:
        if panel.poll(bpy.context):
            draw(panel)


def _of_recipe(extension, scene, picture) -> None:
    """The engine takes the recipe, or the panels say what it misses."""
    folder = extension.bake.places.folder_of(picture)
    try:
        extension.engine.parse(extension.bake.job.describe(scene, picture, folder), folder)
    except ValueError as error:
        assert picture.picture == "" or said_of(extension, scene, picture), f"{picture.name}: {error}"


def said_of(extension, scene, picture) -> list[str]:
    """What the panels ask for before the picture can be baked."""
    missing, replaced = extension.layers.missing, extension.strokes.replaced
    layers = enumerate(picture.layers)
    said = [sentence for i, layer in layers for sentence in missing.of(picture, i, replaced(scene, picture, layer))]
    whole = extension.pictures.place.is_whole(scene, picture)
    return [*said, *([] if picture.layers else ["Add a layer"]), *([] if whole else ["Set Up in Scene"])]


def _of_tree(picture) -> None:
    """Its source and its output are there, and it belongs to the picture."""
    tree = picture.tree
    if tree is not None:
        assert tree.stillwater.picture == picture.id and "Frames" in tree.nodes
        assert [node.bl_idname for node in tree.nodes].count("NodeGroupOutput") == 1
        sockets = [item.name for item in tree.interface.items_tree]
        assert sockets[:4] == ["Image", "Alpha", "Flow", "Matte"]


def _of_nodes(extension, scene) -> None:
    """Nodes of ours in its compositor show pictures that are there."""
    top = extension.versions.compositor_tree(scene)
    ids = {picture.id for other in bpy.data.scenes for picture in other.stillwater.pictures}
    for node in top.nodes if top is not None else ():
        tree = getattr(node, "node_tree", None)
        assert tree is None or not tree.stillwater.picture or tree.stillwater.picture in ids
