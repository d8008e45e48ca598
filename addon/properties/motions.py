"""The numbers of each motion, named, limited and measured as in the recipe. What can't be keyed has options=set()."""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import fluids, names

ICONS = {"still": "PINNED", "sway": "FORCE_WIND", "ripple": "MOD_OCEAN", "bob": "MOD_WAVE"}
ICONS |= {"drift": "OUTLINER_OB_VOLUME", "flow": "MOD_FLUIDSIM", "example": "FILE_MOVIE"}
# Of a motion, what belongs to one place of one picture; the rest is its look, which presets hold.
PLACES = {"armature_root", "armature_tip", "waterline", "water_id", "water", "seed"}
PLACES |= {"clip", "use_clip_frames", "clip_first", "clip_last", "clip_fps", "clip_steady"}
FAR = 1e6  # px: as far from the picture as a place may be


def place(name: str, description: str):
    """A place in the picture: px from its top left corner, y down."""
    return FloatVectorProperty(
        name=name, description=f"{description} [px from the top left corner, y down]", size=2, subtype="XYZ",
        min=-FAR, max=FAR, precision=1, step=100, options=set(),
    )


def seed():
    return IntProperty(
        name="Seed", description="Start of the noise; -1 = one that follows from the names", default=-1, min=-1, options=set()
    )


class STILLWATER_PG_point(bpy.types.PropertyGroup):
    place: place("Place", "A point of the waterline")


class STILLWATER_PG_sway(bpy.types.PropertyGroup):
    """Trees, plants, flags: bend about the root of an armature."""

    armature_root: place("Root", "Where it is held; may lie outside the picture")
    armature_tip: place("Tip", "Its far end; may lie outside the picture")
    frequency: FloatProperty(
        name="Frequency", description="At which it swings by itself [Hz]",
        default=0.6, min=0.001, soft_min=0.1, max=100, soft_max=3, precision=2,
    )
    mass: FloatProperty(
        name="Mass", description="Relative; a heavier one moves less",
        default=1, min=0.001, soft_min=0.1, max=1e6, soft_max=10, options=set(),
    )
    damping: FloatProperty(
        name="Damping", description="How fast its swing dies away [1/s]",
        default=0.4, min=0.001, soft_min=0.05, max=1000, soft_max=3, options=set(),
    )
    amount: FloatProperty(
        name="Amount", description="Strength; 1 moves the tip by 0.05 of the armature's length at 5 m/s (rms)",
        default=1, min=0, max=1000, soft_max=5,
    )
    foreshortening: FloatProperty(
        name="Foreshortening", description="How much it shortens as it bends away (0..1)", subtype="FACTOR",
        default=0, min=0, max=1, options=set(),
    )
    shimmer: FloatProperty(
        name="Shimmer", description="Small independent motion of leaves (0..1)", subtype="FACTOR",
        default=0, min=0, max=1, options=set(),
    )
    seed: seed()


class STILLWATER_PG_ripple(bpy.types.PropertyGroup):
    """Water: a plane of waves under the wind, seen from the picture's view."""

    amplitude: FloatProperty(
        name="Amplitude", description="Height of the waves; 1 is a grown sea at this wind",
        default=1, min=0, max=1000, soft_max=2,
    )
    roughness: FloatProperty(
        name="Roughness", description="How many times the field is tiled over the same water",
        default=1, min=0.001, soft_min=0.1, max=1e4, soft_max=10, options=set(),
    )
    tile: FloatProperty(
        name="Tile", description="Side of the wave field's tile [m]",
        default=60, min=10, max=2000, soft_max=500, options=set(),
    )
    resolution: EnumProperty(
        name="Resolution", description="Wave numbers a side of the tile", default="256", options=set(),
        items=[(str(2**n), str(2**n), f"{2**n} x {2**n} waves") for n in range(4, 12)],
    )
    mode: EnumProperty(
        name="Mode", description="What displaces the picture", default="height", options=set(),
        items=[("height", "Height", "The height of the waves"), ("normal", "Normal", "Their slope: mirror-like water")],
    )
    spectrum: EnumProperty(
        name="Spectrum", description="How the sea's energy is spread over its waves", default="phillips", options=set(),
        items=[
            ("phillips", "Phillips", "A simple wind sea"),
            ("pierson-moskowitz", "Pierson-Moskowitz", "A fully grown sea"),
            ("jonswap", "JONSWAP", "A sea that is still growing, by its fetch"),
            ("tma", "TMA", "JONSWAP in shallow water, by its depth"),
        ],
    )
    fetch: FloatProperty(
        name="Fetch", description="Length of open water under the wind, for JONSWAP and TMA [km]",
        default=100, min=0.01, soft_min=1, max=1e5, soft_max=1000, options=set(),
    )
    depth: FloatProperty(
        name="Depth", description="Depth of the water, for TMA [m]",
        default=200, min=0.01, soft_min=1, max=12000, soft_max=1000, options=set(),
    )
    seed: seed()


class STILLWATER_PG_bob(bpy.types.PropertyGroup):
    """Boats: heave and roll with the water under the waterline."""

    waterline: CollectionProperty(type=STILLWATER_PG_point)
    water_id: StringProperty(options={"HIDDEN"})
    water: StringProperty(
        name="Water", description="The ripple layer that carries it", options=set(),
        get=names.get_layer("water_id"), set=names.set_layer("water_id"), search=names.search_water,
    )
    amount: FloatProperty(
        name="Amount", description="Strength; 1 goes with the water", default=1, min=0, max=1000, soft_max=5
    )


class STILLWATER_PG_drift(bpy.types.PropertyGroup):
    """Clouds: pass endlessly."""

    use_velocity: BoolProperty(
        name="Own Velocity", description="Go at a velocity of its own, not with the wind", options=set()
    )
    velocity: FloatVectorProperty(
        name="Velocity", description="To the right and down [px/frame]", size=2, subtype="XYZ",
        min=-1e4, max=1e4, soft_min=-20, soft_max=20, precision=3,
    )
    wind: FloatProperty(
        name="With the Wind", description="Speed for each m/s of wind along the picture [px/frame]",
        default=0.5, min=-1000, max=1000, soft_min=-2, soft_max=2, precision=3, options=set(),
    )


class STILLWATER_PG_motion(bpy.types.PropertyGroup):
    """What a layer does: its type, and the numbers of every type, so that trying another one loses nothing."""

    type: EnumProperty(
        name="Motion", description="What the layer does", default="still", options=set(),
        items=[
            ("still", "Still", "Does not move", ICONS["still"], 0),
            ("sway", "Sway", "Trees, plants, flags: bends in the wind", ICONS["sway"], 1),
            ("ripple", "Ripple", "Water: waves under the wind", ICONS["ripple"], 2),
            ("bob", "Bob", "Boats: heaves and rolls with the water", ICONS["bob"], 3),
            ("drift", "Drift", "Clouds: passes endlessly", ICONS["drift"], 4),
            ("flow", "Flow", "Rivers, waterfalls, smoke, fire: flows for ever along strokes", ICONS["flow"], 5),
            ("example", "Example", "Looks and moves as a fluid in a clip of yours", ICONS["example"], 6),
        ],
    )
    sway: PointerProperty(type=STILLWATER_PG_sway)
    ripple: PointerProperty(type=STILLWATER_PG_ripple)
    bob: PointerProperty(type=STILLWATER_PG_bob)
    drift: PointerProperty(type=STILLWATER_PG_drift)
    flow: PointerProperty(type=fluids.STILLWATER_PG_flow)
    example: PointerProperty(type=fluids.STILLWATER_PG_example)

    def numbers(self):
        """The numbers of its type; None for still."""
        return getattr(self, self.type, None)


CLASSES = [
    STILLWATER_PG_point,
    STILLWATER_PG_sway,
    STILLWATER_PG_ripple,
    STILLWATER_PG_bob,
    STILLWATER_PG_drift,
    *fluids.CLASSES,
    STILLWATER_PG_motion,
]
