"""From a recipe to a picture's properties: write.py the other way round.

Takes a recipe that the engine has checked and filled with its defaults (engine.read_recipe). What the properties have
no place for is refused, never dropped.
"""

from collections.abc import Callable

from .numbers import kept

Locate = Callable[[str], str]  # a path as the recipe has it -> as Blender keeps it
SetCurve = Callable[[str, int, int, list], None]  # path, index, first frame, a value for each frame
WIDEST = 2**31 - 1  # Blender's whole numbers
MOTIONS = ("still", "sway", "ripple", "bob", "drift")


class NoPlace(ValueError):
    """A part of a recipe that the extension's properties can't hold. `sentence` has its `names` in braces."""

    def __init__(self, sentence: str, **names):
        super().__init__(sentence.format(**names))
        self._sentence, self._names = sentence, names

    def translated(self, said: Callable[[str], str]) -> str:
        """The sentence as `said` has it."""
        return said(self._sentence).format(**self._names)


def fill_picture(picture, recipe: dict, locate: Locate, set_curve: SetCurve, add_layer) -> None:
    """Fills a new picture. `add_layer(picture, name)` makes a layer. Throws NoPlace before anything is changed."""
    refuse(recipe)
    writer = _Writer(set_curve)
    picture.picture = locate(recipe["picture"])
    for name in ("colour_space", "seed", "loop"):
        setattr(picture, name, recipe[name])
    writer.fields(picture.wind, recipe["wind"])
    _view(picture.view, recipe["view"], writer)
    writer.fields(picture.output, recipe["output"])
    for part in recipe["layers"]:  # all before the first is filled: adding one moves the others in memory
        add_layer(picture, part["name"])
    for layer, part in zip(picture.layers, recipe["layers"], strict=True):
        _layer(layer, part, locate, writer)


def refuse(recipe: dict) -> None:
    """Throws NoPlace with a sentence for the first part that has no property yet."""
    if recipe["picture"] is None:
        raise NoPlace("picture: a recipe without one can't be opened in Blender yet")
    seeds = {"seed": recipe["seed"], "wind.seed": recipe["wind"]["seed"]}
    for i, layer in enumerate(recipe["layers"]):
        place, matte, fill, motion = f"layers[{i}]", layer["matte"], layer["fill"], layer["motion"]
        if matte is not None and not {"file", "labels"} & set(matte):
            raise NoPlace("{place}.matte: only the forms file and labels can be opened in Blender yet", place=place)
        if motion["type"] not in MOTIONS:
            sentence = '{place}.motion.type: "{motion}" can\'t be opened in Blender yet'
            raise NoPlace(sentence, place=place, motion=motion["type"])
        plain_fill = {"method": "exemplar", "patch": 9, "radius": None, "grow": 2.0, "source": None, "touch_up": []}
        if fill.get("method") == "exemplar" and {**plain_fill, **fill} != plain_fill:
            raise NoPlace("{place}.fill: numbers of an exemplar fill can't be opened in Blender yet", place=place)
        seeds[f"{place}.motion.seed"] = motion.get("seed")
    for place, seed in seeds.items():
        if seed is not None and seed > WIDEST:
            sentence = "{place}: {seed} is above what Blender can hold ({widest})"
            raise NoPlace(sentence, place=place, seed=seed, widest=WIDEST)


class _Writer:
    """Sets properties under the names of the recipe's fields."""

    def __init__(self, set_curve: SetCurve):
        self._set_curve = set_curve

    def fields(self, group, part: dict, but: tuple = ()) -> None:
        for name, value in part.items():
            if name not in but and value is not None:
                self._set(group, name, value)

    def _set(self, group, name: str, value) -> None:
        kind = group.bl_rna.properties[name]
        if isinstance(value, dict):
            rows = [row if kind.is_array else [row] for row in value["values"]]
            setattr(group, name, rows[0] if kind.is_array else kept(rows[0][0], kind.subtype))
            for index, column in enumerate(zip(*rows, strict=True)):
                path = f"{group.path_from_id()}.{name}"
                self._set_curve(path, index, value["first"], [kept(v, kind.subtype) for v in column])
        elif kind.type == "FLOAT":
            setattr(group, name, value if kind.is_array else kept(value, kind.subtype))
        else:
            setattr(group, name, str(value) if kind.type == "ENUM" else value)


def _view(view, part: dict, writer: _Writer) -> None:
    writer.fields(view, part, but=("horizon",))
    if part["horizon"] is not None:
        view.use_horizon = True
        view.horizon_start, view.horizon_end = part["horizon"]


def _layer(layer, part: dict, locate: Locate, writer: _Writer) -> None:
    writer.fields(layer, part, but=("name", "follows", "matte", "fill", "motion"))
    if part["follows"] is not None:
        writer.fields(layer.follows, part["follows"])
    matte = part["matte"]
    if matte is not None:
        layer.matte.form = "file" if "file" in matte else "labels"
        writer.fields(layer.matte, {**matte, layer.matte.form: locate(matte[layer.matte.form])})
    fill = part["fill"]
    layer.fill.method = fill.get("method", "file")
    if "file" in fill:
        layer.fill.file = locate(fill["file"])
    _motion(layer.motion, part["motion"], writer)


def _motion(motion, part: dict, writer: _Writer) -> None:
    motion.type = part["type"]
    if motion.type == "still":
        return
    group = getattr(motion, motion.type)
    writer.fields(group, part, but=("type", "armature", "waterline"))
    match motion.type:
        case "sway":
            group.armature_root, group.armature_tip = part["armature"]
        case "bob":
            for place in part["waterline"]:
                group.waterline.add().place = place
        case "drift":
            group.use_velocity = part["velocity"] is not None
