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
    motion: str  # of the layers that have it; "" = the picture itself has it
    replaces: tuple[str, ...]  # the numbers that strokes stand for, of the motion or of the view
    colour: tuple[float, float, float]
    icon: str
    hint: str  # what a stroke does, in the status bar while one is drawn
    one: bool  # a new stroke replaces the former
    keyed: bool  # strokes hold from the key on in which they are drawn; else one drawing holds all the time
    geometry: Callable  # strokes -> what the recipe has for them, None where they say nothing
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
)


def by_key(key: str) -> Role:
    return next(role for role in ROLES if role.key == key)


def by_number(number: int) -> Role | None:
    """None for a role of a later version."""
    return next((role for role in ROLES if role.number == number), None)


def of_motion(motion: str) -> list[Role]:
    """The roles of layers that move so; of the picture itself for ""."""
    return [role for role in ROLES if role.motion == motion]
