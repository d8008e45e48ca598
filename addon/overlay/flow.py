"""The flow of a layer over the picture: as streaks that move while it is drawn, fainter where the picture proposes it.

The field is made anew when a stroke is; the streaks go on by a timer. All of it is of a sketch's size.
"""

import json
import time
from dataclasses import dataclass

import bpy
import numpy as np
from bpy.app.translations import pgettext_iface as iface_

from .. import engine
from ..play import show
from ..properties import names
from ..strokes import draw_mode, roles
from . import cutting, flow_field

TURN = 2.0  # s: in which a streak runs its length
STEPS = 10  # redraws of a second
STRONG, FAINT, COLOURED = 0.75, 0.4, 0.55  # opacity

problem = ""  # why there is no flow to see; strokes that are not enough are told by the panel


@dataclass(frozen=True)
class Sight:
    """What is seen of a layer's flow."""

    key: tuple  # of what it was made
    field: np.ndarray
    proposed: bool
    streaks: object


_sight: Sight | None = None
_failed: tuple = ()
_pictures: dict[tuple, tuple[np.ndarray, float]] = {}  # of the last one


def forget() -> None:
    global _sight, _failed
    _sight, _failed = None, ()
    _pictures.clear()
    if bpy.app.timers.is_registered(go_on):
        bpy.app.timers.unregister(go_on)


def layer_of(scene, picture):
    """The layer whose flow is seen: that of which strokes are drawn; or the active one that has none yet, at rest."""
    drawing = scene.stillwater.drawing
    if drawing.role:
        layer = names.layer_by_id(picture, drawing.layer_id) if drawing.picture_id == picture.id else None
        return layer if layer is not None and roles.by_key(drawing.role).motion == "flow" else None
    active = picture.layers[picture.active_layer] if picture.active_layer < len(picture.layers) else None
    if active is None or active.motion.type not in roles.FLUIDS or not active.visible:
        return None
    playing = any(window.screen.is_animation_playing for window in bpy.context.window_manager.windows)
    return None if playing or _directed(scene, picture, active) else active


def of(scene, picture) -> Sight | None:
    """The flow that is to be seen at the scene's frame; None where there is none."""
    global _sight, _failed, problem
    overlay = scene.stillwater_overlay
    layer, stage = layer_of(scene, picture), show.stage_of(scene, picture)
    if layer is None or stage is None or not stage.read or not (overlay.flow or overlay.flow_colors):
        return None
    if engine.problem() or not picture.plane.visible_get():
        return None
    if draw_mode.pen_is_down() and _sight is not None and _sight.key[:2] == (picture.id, layer.id):
        return _sight
    key = (picture.id, layer.id, *_facts(scene, layer, stage))
    if key == _failed:
        return None
    if _sight is None or _sight.key != key:
        try:
            _sight, problem = _seen(scene, picture, layer, stage, key), ""
        except (ValueError, OSError) as error:
            _sight, _failed, problem = None, key, str(error)
            return None
    if not bpy.app.timers.is_registered(go_on):
        bpy.app.timers.register(go_on, first_interval=1 / STEPS)
    return _sight


def _facts(scene, layer, stage) -> tuple:
    """All that the sight of a layer's flow follows from: its strokes at this frame, its matte, what is known of that."""
    said = next((each for each in stage.read["layers"] if each["name"] == layer.name), {})
    motion = _motion_in(stage.read, layer.name)
    drawn = flow_field.reduced(motion, 1, scene.frame_current) if motion is not None else None
    known = stage.live is not None and layer.name in stage.live.layers
    sketches = stage.sketch.number if stage.sketch is not None else 0
    outside = [drawn, said.get("matte"), said.get("feather"), stage.read.get("picture"), stage.read.get("colour_space")]
    return json.dumps(outside), known, stage.share is None, sketches, layer.motion.flow.proposal


def sketched(picture, layer, stage) -> tuple[np.ndarray, float, np.ndarray | None]:
    """The picture at the size of a sketch, its scale, and the layer's matte there. Throws ValueError, OSError."""
    path = stage.folder / stage.read["picture"]
    key = (path, path.stat().st_mtime_ns, stage.read["colour_space"])
    if key not in _pictures:
        _pictures.clear()
        _pictures[key] = flow_field.small(engine.picture_pixels(path, stage.read["colour_space"]))
    pixels, scale = _pictures[key]
    cut = cutting.cut(layer.name, stage.live, stage.sketch, picture.picture_size[0]) if layer.matte.form != "none" else None
    coverage = cut.coverage if cut is not None else _filed_matte(layer, stage)
    return pixels, scale, None if coverage is None else flow_field.bound_of(coverage, pixels.shape[:2])


def _filed_matte(layer, stage) -> np.ndarray | None:
    """The matte that a file says, before the layer is cut out: while no stroke says how it flows it can't be."""
    said = next((each for each in stage.read["layers"] if each["name"] == layer.name), {}).get("matte") or {}
    return engine.file_matte(stage.folder / said["file"], said["channel"]) if said.get("file") else None


def proposal(picture, layer, stage) -> tuple[np.ndarray, float, np.ndarray | None]:
    """The flow that the picture proposes for a layer, at a sketch's size, its scale and the layer's matte."""
    pixels, scale, bound = sketched(picture, layer, stage)
    motion = _motion_in(stage.read, layer.name)
    freeze = flow_field.reduced(motion, scale, 0)["freeze"] if motion is not None else []
    return engine.proposed_flow(layer.motion.flow.proposal, freeze, pixels, bound), scale, bound


def pixels_of(sight: Sight, colours: bool) -> np.ndarray:
    """What is laid over the picture now, height x width x 4, straight alpha."""
    if colours:
        return flow_field.colours(sight.field, COLOURED * (FAINT / STRONG if sight.proposed else 1))
    made = sight.streaks.at(time.monotonic() / TURN % 1)
    return np.concatenate([made[..., :3] / np.maximum(made[..., 3:], 1e-4), made[..., 3:]], axis=2)


def sentence(sight: Sight, layer) -> str:
    """What is told with it."""
    if not sight.proposed:
        return ""
    kind = layer.motion.flow.bl_rna.properties["proposal"].enum_items[layer.motion.flow.proposal].name
    return iface_("Proposed for {kind}: Propose Flow makes it strokes, or draw your own").format(kind=iface_(kind))


def go_on() -> float | None:
    """The streaks move as long as they are seen; called by a timer."""
    for window in bpy.context.window_manager.windows:
        picture = window.scene.stillwater.active()
        if picture is not None and picture.plane is not None and layer_of(window.scene, picture) is not None:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()
            return 1 / STEPS
    return None


def _seen(scene, picture, layer, stage, key: tuple) -> Sight:
    motion = _motion_in(stage.read, layer.name)
    if motion is None:
        raise ValueError(iface_("The layer does not flow"))
    directed = any(stroke["kind"] != "speed" for stroke in motion["strokes"])
    if directed:
        pixels, scale, bound = sketched(picture, layer, stage)
        field = engine.painted_flow(picture=pixels, bound=bound, **flow_field.reduced(motion, scale, scene.frame_current))
    else:
        field, scale, bound = proposal(picture, layer, stage)
    if bound is not None:
        field = field * bound[..., None]
    return Sight(key, field, not directed, engine.streaks(field, STRONG if directed else FAINT))


def _motion_in(recipe: dict, name: str) -> dict | None:
    motion = next((layer["motion"] for layer in recipe["layers"] if layer["name"] == name), {})
    return motion if motion.get("type") in roles.FLUIDS else None


def _directed(scene, picture, layer) -> bool:
    """Whether strokes say where the layer flows."""
    stage = show.stage_of(scene, picture)
    motion = _motion_in(stage.read, layer.name) if stage is not None and stage.read else None
    return motion is not None and any(stroke["kind"] != "speed" for stroke in motion["strokes"])
