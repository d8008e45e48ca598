"""`stillwater check FILE`: is the recipe right?"""

from ..recipe import load


def add_to(commands) -> None:
    parser = commands.add_parser("check", help="say what is wrong with a recipe, if anything")
    parser.add_argument("file", help="recipe (JSON)")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    document = load(given.file)
    first, last = document.recipe.frames
    layers = len(document.recipe.layers)
    print(f"{given.file}: a right recipe, {layers} layer{'s' if layers > 1 else ''}, {last - first + 1} frames")
