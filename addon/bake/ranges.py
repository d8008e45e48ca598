"""Which frames a bake is asked for: all of the scene's, or a part of them."""

from bpy.app.translations import pgettext_rpt as rpt_

ITEMS = [
    ("ALL", "All Frames", "Every frame of the scene's range"),
    ("PREVIEW", "Preview Range", "The preview range of the timeline"),
    ("VISIBLE", "Visible Frames", "The frames that a timeline or dope sheet of this window shows"),
    ("CURRENT", "Current Frame", "This frame alone"),
]


def frames_of(context, kind: str) -> tuple[int, int] | None:
    """First and last frame of a range, within the scene's; None for all. Throws ValueError where it has none."""
    scene = context.scene
    match kind:
        case "ALL":
            return None
        case "PREVIEW":
            if not scene.use_preview_range:
                raise ValueError(rpt_("The timeline has no preview range; set one with P, or bake all frames"))
            first, last = scene.frame_preview_start, scene.frame_preview_end
        case "VISIBLE":
            first, last = _visible(context)
        case _:
            first = last = scene.frame_current
    within = max(first, scene.frame_start), min(last, scene.frame_end)
    if within[0] > within[1]:
        if first == last:
            sentence = rpt_("Frame {first} is not within the scene's frames, {start} to {end}")
        else:
            sentence = rpt_("Frames {first} to {last} are not within the scene's frames, {start} to {end}")
        asked = {"first": first, "last": last, "start": scene.frame_start, "end": scene.frame_end}
        raise ValueError(sentence.format(**asked))
    return within


def _visible(context) -> tuple[int, int]:
    window = context.window
    areas = [area for area in window.screen.areas if area.type == "DOPESHEET_EDITOR"] if window else []
    regions = [region for area in areas for region in area.regions if region.type == "WINDOW" and region.width > 1]
    if not regions:
        raise ValueError(rpt_("No timeline or dope sheet is open; open one, or bake all frames"))
    left, right = (regions[0].view2d.region_to_view(x, 0)[0] for x in (0, regions[0].width))
    return round(left), round(right)
