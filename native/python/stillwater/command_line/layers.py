"""`stillwater layers RECIPE -o FOLDER`: the layers cut out of its picture, each as a picture."""

from pathlib import Path

from . import cache_options


def add_to(commands) -> None:
    parser = commands.add_parser("layers", help="write the layers cut out of a recipe's picture, the front first")
    parser.add_argument("file", help="recipe (JSON)")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER", help="where they go")
    parser.add_argument("--format", choices=("png", "exr"), default="png", help="default: png")
    cache_options.add_to(parser)
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from .. import _stillwater as engine

    engine.install_signal_handler()
    from ..recipe import load
    from ..render.cache import FOLDER, LIMIT, Cache
    from ..render.events import LayerFile
    from ..render.layer_files import write_layers
    from .show import Warnings

    document, show = load(given.file), Warnings()
    cache = Cache(given.cache.absolute() if given.cache else document.folder / FOLDER, given.cache_limit or LIMIT)
    for event in write_layers(document, given.output.absolute(), cache, given.format):
        show(event)
        if isinstance(event, LayerFile):
            print(event.path, flush=True)
