"""`stillwater flow PICTURE -o FLOW`: the flow that strokes paint over a picture, or that it proposes itself."""

from .files import check_ending, drawing, named, read_picture, warn

FORMATS = (".exr", ".flo")
IMAGES = (".exr", ".jpeg", ".jpg", ".png", ".tif", ".tiff")
KINDS = ("water", "falls", "fire", "smoke", "sky")


def add_to(commands) -> None:
    parser = commands.add_parser("flow", help="paint a fluid's flow over a picture, or have it proposed")
    parser.add_argument("file", metavar="PICTURE", help="the picture")
    parser.add_argument("--strokes", metavar="FILE", help="JSON: a list of the recipe's flow strokes")
    parser.add_argument(
        "--kind", choices=KINDS, help="what flows: the picture proposes the field (water), strokes correct it"
    )
    parser.add_argument("--width", type=float, metavar="PX", help="blur of the refinement of painted strokes (12)")
    parser.add_argument("-o", "--output", required=True, metavar="FLOW", help="px/frame: .exr (channels X, Y) or .flo")
    parser.add_argument("--streaks", metavar="IMAGE", help="the picture with the flow as streaks over it")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from .. import _stillwater as engine
    from ..flow_painting import streaks
    from ..images import write, write_flow
    from ..layers import over
    from ..render.errors import Refused

    engine.install_signal_handler()
    check_ending(given.output, FORMATS)
    if given.streaks:
        check_ending(given.streaks, IMAGES)
    if given.width is not None and (not given.strokes or given.kind):
        raise Refused("--width: a proposed flow is not refined; only painted strokes without --kind are")
    picture, sentences = read_picture(given.file)
    warn(sentences)
    flow = _flow(given, picture)
    write_flow(given.output, flow)
    if given.streaks:
        write(given.streaks, over(streaks(flow), picture))


def _flow(given, picture):
    from ..flow_painting import paint_flow, propose_flow, refine_flow

    strokes = _strokes(given.strokes) if given.strokes else []
    with named(given.strokes or given.file):
        if strokes and not given.kind:
            painted = paint_flow(strokes, (picture.shape[1], picture.shape[0]))
            return refine_flow(painted, picture, width=12.0 if given.width is None else given.width)
        proposed = propose_flow(picture, given.kind or "water", strokes)
    return proposed.orientation * proposed.speed[..., None]


def _strokes(path: str):
    from ..recipe.flow_strokes import load_flow_strokes
    from ..render.errors import Refused

    with drawing(path):
        strokes = load_flow_strokes(path)
    if not strokes:
        raise Refused(f"{path}: holds no stroke; without --strokes the picture proposes a flow")
    return strokes
