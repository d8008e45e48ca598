"""Pictures with several layers, and what is said about them after any step."""

import json

import bpy


def fill(extension, picture, *names: str):
    """Gives a picture these layers, front first, each of another opacity."""
    extension.properties.arrange.remove_layers(picture, list(range(len(picture.layers))))
    for i, name in enumerate(names):
        extension.properties.arrange.add_layer(picture, name).opacity = 0.1 * (i + 1)
    picture.active_layer = 0


def now():
    """The active picture, looked up anew: undo replaces everything."""
    return bpy.context.scene.stillwater.active()


def order() -> str:
    return " ".join(layer.name for layer in now().layers)


def selected() -> str:
    picture = now()
    chosen = [i for i, layer in enumerate(picture.layers) if layer.selected or i == picture.active_layer]
    return " ".join(picture.layers[i].name for i in chosen)


def select(*names: str) -> None:
    """The first one named becomes the active one."""
    picture = now()
    for layer in picture.layers:
        layer.selected = layer.name in names
    picture.active_layer = picture.layers.find(names[0])


def key(extension, path: str, *points: tuple, index: int = 0):
    extension.versions.set_curve(bpy.context.scene, path, index, list(points))
    return next(c for c in keyed(extension) if (c.data_path, c.array_index) == (path, index))


def keyed(extension, scene=None) -> list:
    data = (scene or bpy.context.scene).animation_data
    return extension.versions.curves_of(data.action, data.action_slot) if data else []


def drive(path: str, expression: str, reads: str = "", scene=None):
    """A driver of a property of the scene; `reads`: the path, in `scene`, of its variable v."""
    curve = bpy.context.scene.driver_add(path)
    curve.driver.type = "SCRIPTED"
    if reads:
        variable = curve.driver.variables.new()
        variable.name = "v"
        variable.targets[0].id_type = "SCENE"
        variable.targets[0].id = scene or bpy.context.scene
        variable.targets[0].data_path = reads
    curve.driver.expression = expression
    return curve


def said(extension) -> dict:
    """The recipe of the active picture."""
    with open(extension.bake.job.write_recipe(bpy.context.scene, now())) as file:
        return json.load(file)


def over_time(extension, name: str, *path: str):
    """What the recipe says about a field of a layer, at frames 1 to 4."""
    value = next(layer for layer in said(extension)["layers"] if layer["name"] == name)
    for part in path:
        value = value[part]
    return value if not isinstance(value, dict) else value["values"][:4]
