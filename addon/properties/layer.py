"""One layer of a picture: its matte, what is behind it, whom it follows, how it moves."""

import bpy
from bpy.props import BoolProperty, FloatProperty, PointerProperty, StringProperty

from . import names
from .cut_out import STILLWATER_PG_fill, STILLWATER_PG_matte
from .motions import STILLWATER_PG_motion


class STILLWATER_PG_follows(bpy.types.PropertyGroup):
    """A shadow or a reflection goes with another layer's motion."""

    layer_id: StringProperty(options={"HIDDEN"})
    layer: StringProperty(
        name="Follows", description="Layer that it goes with, as a shadow or a reflection does", options=set(),
        get=names.get_layer("layer_id"), set=names.set_layer("layer_id"), search=names.search_layers,
    )
    mirror: BoolProperty(name="Mirror", description="Mirror its motion, as a reflection does", options=set())


def select_active(picture, context) -> None:
    """Clicking a layer selects it alone; one that is selected already becomes the active one of the selection."""
    if picture.active_layer < len(picture.layers) and not picture.layers[picture.active_layer].selected:
        for i, layer in enumerate(picture.layers):
            layer.selected = i == picture.active_layer


class STILLWATER_PG_layer(bpy.types.PropertyGroup):
    """One piece of the picture and its motion."""

    id: StringProperty(options={"HIDDEN"})
    name: StringProperty(
        name="Name", description="Unique in its picture", maxlen=200, options=set(),
        update=lambda self, context: names.rename_layer(self),
    )
    selected: BoolProperty(
        name="Select", description="Take the layer along in what is done to all selected ones. Drag over several boxes",
        options=set(),
    )
    visible: BoolProperty(
        name="Visible", description="Show the layer; a hidden one shows what fills the hole behind it",
        default=True, options=set(),
    )
    solo: BoolProperty(
        name="Solo", options=set(),
        description="See only the layers with a star while playing; what is baked are always all visible layers",
    )
    opacity: FloatProperty(name="Opacity", description="How much of the layer is seen (0..1)", default=1, min=0, max=1, subtype="FACTOR")
    feather: FloatProperty(
        name="Feather", description="Softens the matte [px]", subtype="PIXEL",
        default=0, min=0, max=1000, soft_max=50, options=set(),
    )
    follows: PointerProperty(type=STILLWATER_PG_follows)
    matte: PointerProperty(type=STILLWATER_PG_matte)
    fill: PointerProperty(type=STILLWATER_PG_fill)
    motion: PointerProperty(type=STILLWATER_PG_motion)

    def seen(self) -> bool:
        """Whether it is seen while playing: visible, and one of those with a star where there are any."""
        solo = any(layer.solo for layer in names.picture_of(self).layers)
        return self.visible and (self.solo or not solo)


CLASSES = [STILLWATER_PG_follows, STILLWATER_PG_layer]
