"""What a stroke can be: one entry for each role, which recipe/write.py asks for by its key. No bpy."""

from collections.abc import Callable
from dataclasses import dataclass

from . import lines


@dataclass(frozen=True)
class Role:
    """What strokes of one kind say, and how they are shown."""

    key: str
    number: int  # kept in .blend files: never given to another role
    name: str
    motion: str  # of the layers that have it; "" = the picture itself, or all layers where `of` says of what
    replaces: tuple[str, ...]  # the numbers that strokes stand for, of the motion or of the view
    colour: tuple[float, float, float]
    icon: str
    hint: str  # what a stroke does, in the status bar while one is drawn
    one: bool  # a new stroke replaces the former
    keyed: bool  # strokes hold from the key on in which they are drawn; else one drawing holds all the time
    geometry: Callable  # strokes -> what the recipe has for them, None where they say nothing
    of: str = ""  # what of a layer they say, and its form: "matte.scribbles", "fill.exemplar", "source.lasso"
    points: int = 2  # a stroke with fewer says nothing
    brushed: bool = False  # each stroke has a speed, a weight and a reach of its own (brush.py)
    on_clip: bool = False  # drawn on the layer's clip, and measured in its pixels; else on the picture
    is_typed: Callable = lambda numbers: False  # whether the numbers that strokes stand for say it as well


ROLES = (
    Role(
        key="sway_line", number=1, name="Sway Line", motion="sway", replaces=("armature_root", "armature_tip"),
        is_typed=lambda sway: tuple(sway.armature_root) != tuple(sway.armature_tip),
        colour=(1.0, 0.45, 0.05), icon="IPO_ELASTIC", one=True, keyed=False, geometry=lines.ends,
        hint="Draw from the root, which is held, to the tip, which sways; a new line replaces the former",
    ),
    Role(
        key="waterline", number=2, name="Waterline", motion="bob", replaces=("waterline",),
        is_typed=lambda bob: len(bob.waterline) > 1,
        colour=(0.0, 0.75, 1.0), icon="MOD_OCEAN", one=True, keyed=False, geometry=lines.polyline,
        hint="Draw along the hull where it meets the water; a new line replaces the former",
    ),
    Role(
        key="horizon", number=3, name="Horizon", motion="", replaces=("use_horizon", "horizon_start", "horizon_end"),
        is_typed=lambda view: view.use_horizon and tuple(view.horizon_start) != tuple(view.horizon_end),
        colour=(1.0, 0.1, 0.7), icon="REMOVE", one=True, keyed=False, geometry=lines.straight_line,
        hint="Draw along the horizon, where the water would end; a new line replaces the former",
    ),
    Role(
        key="foreground", number=4, name="Foreground", motion="", of="matte.scribbles", replaces=("foreground",),
        colour=(0.1, 0.9, 0.25), icon="ADD", one=False, keyed=False, geometry=lines.all_strokes, points=1,
        hint="Draw on what is part of the layer: a few short strokes, one over each of its colors",
    ),
    Role(
        key="background", number=5, name="Background", motion="", of="matte.scribbles", replaces=("background",),
        colour=(0.95, 0.1, 0.1), icon="REMOVE", one=False, keyed=False, geometry=lines.all_strokes, points=1,
        hint="Draw on what is not part of the layer: a few short strokes around it",
    ),
    Role(
        key="outline", number=6, name="Outline", motion="", of="matte.lasso", replaces=("outline",),
        colour=(1.0, 0.85, 0.1), icon="MOD_OUTLINE", one=True, keyed=False, geometry=lines.polygon, points=3,
        hint="Draw once around the layer; it closes by itself, and a new outline replaces the former",
    ),
    Role(
        key="touch_up", number=7, name="Touch-Up", motion="", of="fill.exemplar", replaces=("touch_up",),
        colour=(0.75, 0.35, 1.0), icon="BRUSH_DATA", one=False, keyed=False, geometry=lines.touch_ups, points=1,
        hint="Draw over what is badly filled behind the layer; it is filled again, by Touch-Up Radius and Seed",
    ),
    Role(
        key="source_foreground", number=8, name="Source Foreground", motion="", of="source.scribbles",
        replaces=("source_foreground",), colour=(0.1, 0.8, 0.7), icon="ADD", one=False, keyed=False,
        geometry=lines.all_strokes, points=1, hint="Draw on what the hole behind the layer may be filled with",
    ),
    Role(
        key="source_background", number=9, name="Source Background", motion="", of="source.scribbles",
        replaces=("source_background",), colour=(0.8, 0.3, 0.1), icon="REMOVE", one=False, keyed=False,
        geometry=lines.all_strokes, points=1, hint="Draw on what the hole behind the layer must not be filled with",
    ),
    Role(
        key="source_outline", number=10, name="Source Outline", motion="", of="source.lasso",
        replaces=("source_outline",), colour=(0.4, 0.9, 1.0), icon="MOD_OUTLINE", one=True, keyed=False,
        geometry=lines.polygon, points=3,
        hint="Draw once around what the hole behind the layer may be filled with; a new outline replaces the former",
    ),
    Role(
        key="flow", number=11, name="Flow", motion="flow", replaces=("strokes",), brushed=True,
        colour=(0.15, 0.55, 1.0), icon="MOD_FLUIDSIM", one=False, keyed=True, geometry=lines.flow_strokes("both"),
        hint="Draw the way that it flows, as fast as Stroke Speed says; a few long strokes are enough",
    ),
    Role(
        key="orientation", number=12, name="Direction", motion="flow", replaces=("strokes",), brushed=True,
        colour=(0.3, 0.95, 0.85), icon="ORIENTATION_NORMAL", one=False, keyed=True,
        geometry=lines.flow_strokes("orientation"),
        hint="Draw the way that it flows; how fast is said by the other strokes",
    ),
    Role(
        key="speed", number=13, name="Speed", motion="flow", replaces=("speeds",), brushed=True,
        colour=(1.0, 0.7, 0.25), icon="PREVIEW_RANGE", one=False, keyed=True, geometry=lines.flow_strokes("speed"),
        hint="Draw where it is as fast as Stroke Speed says, in any direction; 0 is still water", points=1,
    ),
    Role(
        key="freeze", number=14, name="Hold Still", motion="flow", replaces=("freeze",),
        colour=(0.8, 0.85, 0.95), icon="FREEZE", one=False, keyed=False, geometry=lines.all_strokes, points=1,
        hint="Draw over what stays where it is: rocks, banks, logs",
    ),
    Role(
        key="clone_source", number=15, name="Clone Source", motion="example", replaces=("clone_sources",), on_clip=True,
        colour=(1.0, 0.55, 0.85), icon="EYEDROPPER", one=False, keyed=False, geometry=lines.all_strokes,
        hint="Draw on the clip, below the picture, along what is to be taken; the first goes to the first Clone Target",
    ),
    Role(
        key="clone_target", number=16, name="Clone Target", motion="example", replaces=("clone_targets",), brushed=True,
        colour=(0.85, 0.25, 0.9), icon="DUPLICATE", one=False, keyed=False, geometry=lines.clone_targets,
        hint="Draw on the picture where what a Clone Source takes is to go, as wide as the pen; the first is of the first",
    ),
)


FLUIDS = ("flow", "example")  # what flows is said by the same strokes


def by_key(key: str) -> Role:
    return next(role for role in ROLES if role.key == key)


def by_number(number: int) -> Role | None:
    """None for a role of a later version."""
    return next((role for role in ROLES if role.number == number), None)


def of_motion(motion: str) -> list[Role]:
    """The roles of layers that move so; of the picture itself for ""."""
    return [role for role in ROLES if role.motion == motion and not role.of]


def of_layer(layer) -> list[Role]:
    """The roles that a layer has: by its motion, its matte and its fill."""
    return [role for role in ROLES if is_of_layer(role) and has(layer, role)]


def is_of_layer(role: Role) -> bool:
    """Whether layers have it; else the picture itself."""
    return bool(role.motion or role.of)


def has(layer, role: Role) -> bool:
    """Whether strokes of this role say something of a layer as it is."""
    if not role.of:
        return layer.motion.type in (FLUIDS if role.motion == "flow" else (role.motion,))
    what, _, form = role.of.partition(".")
    if what == "matte":
        return layer.matte.form == form
    filled = layer.fill.method == "exemplar"
    return filled and (what == "fill" or layer.fill.source.form == form)


def begins(layer, role: Role) -> bool:
    """Whether drawing such a stroke would choose the kind of the layer's matte: it has none yet."""
    matte = layer.matte
    unsaid = matte.form == "none" or (matte.form in ("file", "labels", "trimap") and not getattr(matte, matte.form))
    return role.of.startswith("matte.") and unsaid


def begin(layer, role: Role) -> None:
    """Chooses it."""
    if begins(layer, role):
        layer.matte.form = role.of.partition(".")[2]
