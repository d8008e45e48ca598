"""`stillwater analyse CLIP -o FILE`: a clip of a fluid, taken apart into its average, flow and residuals."""

from .files import check_ending, frame_range, named, warn


def add_to(commands) -> None:
    parser = commands.add_parser("analyse", help="take a clip of a fluid apart")
    parser.add_argument("file", metavar="CLIP", help="the clip")
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help=".npz: what `stillwater.read_analysis` reads")
    parser.add_argument("--frames", type=frame_range, metavar="A-B", help="first and last frame that are taken (all)")
    parser.add_argument("--flow", choices=("dense", "features"), default="dense", help="how its mean flow is found (dense)")
    parser.add_argument("--quality", choices=("fast", "medium", "best"), default="medium", help="of the dense flow (medium)")
    parser.add_argument("--steady", action="store_true", help="take the camera's shake out first")
    parser.add_argument("--memory", type=float, default=1200.0, metavar="MB", help="what it may need (1200)")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from .. import _stillwater as engine
    from ..example import analyse, write_analysis

    engine.install_signal_handler()
    check_ending(given.output, (".npz",))
    with named(given.file):
        found = analyse(given.file, given.frames, given.flow, given.quality, given.steady, given.memory)
    warn(found.warnings)
    write_analysis(given.output, found)
    count, height, width, _ = found.residuals.shape
    speed = float((found.velocity**2).sum(axis=2).max()) ** 0.5
    print(f"frames     {count} of {width} x {height} px, {found.fps:g} a second")
    print(f"flow       up to {speed:.2f} px a frame; predicts {max(0.0, found.explained):.0%} of what changes")
