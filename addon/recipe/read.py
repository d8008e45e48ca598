"""From a recipe to a picture's properties: write.py the other way round.

Takes a recipe that the engine has checked and filled with its defaults (engine.read_recipe). What the properties have
no place for is refused, never dropped.
"""

from collections.abc import Callable

from .flow import drawn_of
from .numbers import kept

Locate = Callable[[str], str]  # a path as the recipe has it -> as Blender keeps it
SetCurve = Callable[[str, int, int, list], None]  # path, index, first frame, a value for each frame
WIDEST = 2**31 - 1  # Blender's whole numbers
MOTIONS = ("still", "sway", "ripple", "bob", "drift", "flow", "example")
PARTS = ("strokes", "refine", "freeze", "outline", "transfer", "clip", "clip_frames")  # of fluids: in other properties
FORMS = ("file", "labels", "scribbles", "lasso", "trimap")


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
        if motion["type"] not in MOTIONS:
            sentence = '{place}.motion.type: "{motion}" can\'t be opened in Blender yet'
            raise NoPlace(sentence, place=place, motion=motion["type"])
        seeds[f"{place}.motion.seed"] = motion.get("seed")
        for part, said in ((f"{place}.matte", matte or {}), (f"{place}.fill.source", fill.get("source") or {})):
            seeds[f"{part}.value"] = said.get("value")
        for j, touch_up in enumerate(fill.get("touch_up", ())):
            seeds[f"{place}.fill.touch_up[{j}].seed"] = touch_up["seed"] + 1  # 0 is kept for none of its own
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
    _matte(layer.matte, part["matte"], locate, writer)
    fill = part["fill"]
    layer.fill.method = fill.get("method", "file")
    if "file" in fill:
        layer.fill.file = locate(fill["file"])
    if layer.fill.method == "exemplar":
        writer.fields(layer.fill, fill, but=("method", "source", "touch_up"))
        _matte(layer.fill.source, fill["source"], locate, writer)
        if usual := _usual_touch_up(fill["touch_up"]):
            layer.fill.touch_up_radius, layer.fill.touch_up_seed = usual["radius"] or 0, usual["seed"]
    _motion(layer.motion, part["motion"], locate, writer)


def _matte(matte, said: dict | None, locate: Locate, writer: _Writer) -> None:
    """What is drawn of it comes later (strokes_of)."""
    if said is None:
        return
    matte.form = next(form for form in FORMS if form in said)
    located = {matte.form: locate(said[matte.form])} if matte.form in ("file", "labels", "trimap") else {}
    writer.fields(matte, {**said, **located}, but=("scribbles", "lasso"))


def clips_drawn_on(recipe: dict) -> list[str]:
    """The clips of a recipe on which something is drawn, as it names them."""
    motions = [layer["motion"] for layer in recipe["layers"]]
    return [motion["clip"] for motion in motions if motion.get("transfer", {}).get("strokes") and "clip" in motion]


def strokes_of(part: dict) -> dict[str, list]:
    """What is drawn of a recipe's layer, by the keys of strokes/roles.py. A touch-up without a number has its layer's."""
    fill = part["fill"]
    found = {**_drawn(part["matte"], ""), **_drawn(fill.get("source"), "source_")}
    touched, usual = fill.get("touch_up") or [], _usual_touch_up(fill.get("touch_up"))
    if part["motion"]["type"] in ("flow", "example"):
        found |= drawn_of(part["motion"])
    found["touch_up"] = [{"stroke": each["stroke"]} for each in touched] if usual else touched
    return {key: strokes for key, strokes in found.items() if strokes}


def _drawn(matte: dict | None, prefix: str) -> dict[str, list]:
    matte = matte or {}
    scribbles = {f"{prefix}{kind}": strokes for kind, strokes in matte.get("scribbles", {}).items()}
    return {**scribbles, f"{prefix}outline": [list(corner) for corner in matte.get("lasso", ())]}


def _usual_touch_up(touched: list | None) -> dict | None:
    """The numbers that all touch-ups of a fill have in common, where they do."""
    numbers = [{name: each[name] for name in ("radius", "seed")} for each in touched or ()]
    return numbers[0] if numbers and all(each == numbers[0] for each in numbers) else None


def _motion(motion, part: dict, locate: Locate, writer: _Writer) -> None:
    motion.type = part["type"]
    if motion.type == "still":
        return
    group = getattr(motion, motion.type)
    writer.fields(group, part, but=("type", "armature", "waterline", *PARTS))
    match motion.type:
        case "sway":
            group.armature_root, group.armature_tip = part["armature"]
        case "bob":
            for place in part["waterline"]:
                group.waterline.add().place = place
        case "drift":
            group.use_velocity = part["velocity"] is not None
        case "flow":
            _flowing(motion.flow, group, part)
        case "example":
            _flowing(motion.flow, group, part)
            _example(group, part, locate)


def _example(example, part: dict, locate: Locate) -> None:
    example.clip, example.use_grid = locate(part["clip"]), part["grid"] is not None
    example.transfer_patch, example.transfer_order = part["transfer"]["patch"], part["transfer"]["order"]
    if part["clip_frames"] is not None:
        example.use_clip_frames, (example.clip_first, example.clip_last) = True, part["clip_frames"]


def _flowing(brush, flow, part: dict) -> None:
    """What all fluids have. The next stroke goes on as the last one of the recipe: `brush` says what it gets."""
    flow.refine_width, flow.refine_amount = part["refine"]["width"], part["refine"]["amount"]
    if part["outline"] is not None:
        flow.outline_moving, flow.outline_persistence = part["outline"]["moving"], part["outline"]["persistence"]
    if part["strokes"]:
        last = part["strokes"][-1]
        brush.stroke_speed, brush.stroke_local, brush.stroke_alpha = last["speed"], last["local"], last["alpha"]
