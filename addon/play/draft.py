"""What of a recipe can be cut out already, while other things of it are missing. Needs no bpy."""

DRAWN = ("scribbles", "lasso", "trimap")  # the forms of a matte that is solved


def draft_of(recipe: dict) -> dict:
    """A still recipe of the layers that have a matte, over the last one: what is missing of a motion does not matter.

    It is cut out as `recipe` is, as far as both have the same layers: what is prepared for one serves the other.
    """
    *before, last = recipe["layers"]
    layers = [_at_rest(layer) for layer in before if "matte" in layer] + [_at_rest(last)]
    return {**{name: value for name, value in recipe.items() if name not in ("wind", "view")}, "layers": layers}


def _at_rest(layer: dict) -> dict:
    names = ("name", "visible", "opacity", "feather", "matte", "fill")
    return {name: layer[name] for name in names if name in layer}


def solved_matte(recipe: dict, name: str) -> dict | None:
    """The matte of the layer of this name where it is solved from what an artist drew or painted."""
    layer = next((layer for layer in recipe.get("layers", ()) if layer["name"] == name), {})
    matte = layer.get("matte", {})
    return matte if any(form in matte for form in DRAWN) else None


def behind(recipe: dict, name: str) -> dict:
    """The recipe without the layer of this name and all before it; what fills their holes is seen."""
    names = [layer["name"] for layer in recipe["layers"]]
    hidden = names[: names.index(name) + 1] if name in names else []
    layers = [{**layer, "visible": False} if layer["name"] in hidden else layer for layer in recipe["layers"]]
    return {**recipe, "layers": layers}
