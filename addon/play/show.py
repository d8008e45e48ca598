"""All pictures of a scene at its frame, on their planes."""

import bpy

from .. import engine, preferences
from ..properties import names
from . import plane, recipes, server
from .draft import behind, solved_matte
from .stage import Stage, moves

_stages: dict[tuple[int, str], Stage] = {}  # by the scene's session_uid and the picture's id
seen = not bpy.app.background  # whether anybody looks


def stage_of(shown, picture) -> Stage | None:
    """What is known of a picture of a scene; None before it was first shown."""
    return _stages.get((shown.session_uid, picture.id))


def scene(shown, refresh: bool = True) -> None:
    """Shows the pictures of a scene at its frame. With `refresh` their recipes are looked at anew.

    Whatever goes wrong is a sentence in the panel.
    """
    if not seen:
        return
    for picture in shown.stillwater.pictures:
        key = (shown.session_uid, picture.id)
        if key not in _stages:
            _stages[key], refresh = Stage(picture.id, _answered(shown.session_uid)), True
        try:
            _show(shown, picture, _stages[key], refresh)
        except Exception as error:  # noqa: BLE001  a handler that raises would fill the console at every frame
            known = isinstance(error, ValueError | OSError)
            _stages[key].problem = str(error) if known else f"{type(error).__name__}: {error}"
            _clear(picture, _stages[key])
    _redraw()


def _answered(uid: int):
    """What is done when the server has answered a stage of a scene: it may be gone by then."""

    def show() -> None:
        found = next((each for each in bpy.data.scenes if each.session_uid == uid), None)
        if found is not None:
            scene(found, refresh=False)

    return show


def again(shown) -> None:
    """Shows a scene's pictures, and tries anew what went wrong."""
    for picture in shown.stillwater.pictures:
        if stage := stage_of(shown, picture):
            stage.again()
    scene(shown)


def put_back() -> None:
    """Every plane shows the picture's own image: for a file that is saved, or one that comes from elsewhere."""
    for stage in _stages.values():
        stage.shown = ()
    for each in bpy.data.scenes:
        for picture in each.stillwater.pictures:
            plane.clear(picture)


def forget() -> None:
    """Another file."""
    recipes.forget()
    _stages.clear()


def tidy() -> None:
    """Forgets what belongs to pictures that are gone."""
    here = {(each.session_uid, picture.id) for each in bpy.data.scenes for picture in each.stillwater.pictures}
    gone = [key for key in _stages if key not in here]
    for key in gone:
        _stages.pop(key).close()
    if gone:
        plane.sweep({identifier for _, identifier in here})


def _show(shown, picture, stage: Stage, refresh: bool) -> None:
    settings = shown.stillwater_live
    if refresh or recipes.is_driven(shown, picture) or not stage.read:
        recipe, folder = recipes.now(shown, picture)
        stage.look(recipe)
        stage.folder = folder
    wanted = settings.on and settings.view != "original" and not engine.problem()
    if not wanted or picture.plane is None or picture.image is None:
        _clear(picture, stage)
        return
    view, active = settings.view, _active(shown, picture)
    if shown.stillwater.drawing.role:
        server.wake()
    stage.rests = view == "picture" and not moves(stage.read)
    if not stage.rests or solved_matte(stage.read, active):
        chosen = preferences.of(bpy.context)
        recipe = behind(stage.read, active) if view == "behind" else stage.read
        stage.take(recipe, stage.folder, chosen.preview_size, chosen.cache(), active)
    layer = _layer(picture, view)
    wrong = stage.problem and not (stage.drafted and view != "picture")
    if stage.rests or wrong or stage.live is None or layer not in (None, *stage.live.layers):
        _clear(picture, stage)
        return
    what = (stage.taken, shown.frame_current, layer, view)
    if what != stage.shown or not plane.shows(picture):
        plane.show(picture, stage.live.frame(shown.frame_current, layer, matte=view == "matte"))
        stage.shown = what


def _active(shown, picture) -> str:
    """The name of the layer that is drawn on, or else of the active one."""
    drawing = shown.stillwater.drawing
    drawn = names.layer_by_id(picture, drawing.layer_id) if drawing.role and drawing.picture_id == picture.id else None
    if drawn is not None:
        return drawn.name
    return picture.layers[picture.active_layer].name if picture.active_layer < len(picture.layers) else ""


def _layer(picture, view: str) -> str | None:
    """The name of the layer that is shown alone; None where all are, or all behind it."""
    if view in ("picture", "behind") or picture.active_layer >= len(picture.layers):
        return None
    return picture.layers[picture.active_layer].name


def _clear(picture, stage: Stage) -> None:
    plane.clear(picture)
    stage.shown = ()


def _redraw() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
