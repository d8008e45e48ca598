"""`stillwater matte PICTURE -o ALPHA`: what scribbles, an outline or a trimap cut out of a picture."""

import contextlib
import sys

FORMATS = (".exr", ".jpeg", ".jpg", ".png", ".tif", ".tiff")


def add_to(commands) -> None:
    parser = commands.add_parser("matte", help="cut something out of a picture, softly")
    parser.add_argument("file", metavar="PICTURE", help="the picture")
    drawn = parser.add_mutually_exclusive_group(required=True)
    drawn.add_argument("--scribbles", metavar="FILE", help='JSON: {"foreground": [stroke], "background": [stroke]}, or a lasso')
    drawn.add_argument("--trimap", metavar="FILE", help="white is in, black is out, grey is unknown")
    parser.add_argument("-o", "--output", required=True, metavar="ALPHA", help="the matte; .png, .tif, .exr, .jpg")
    parser.add_argument("--foreground", metavar="OUT", help="what is cut out too, in its own colours, with alpha")
    parser.add_argument("--method", choices=("closed-form", "bayesian"), help="how what is unknown is solved (closed-form)")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from .. import _stillwater as engine
    from ..images import write
    from ..matting import cut_out, matte, write_matte

    engine.install_signal_handler()
    for path in filter(None, (given.output, given.foreground)):
        _check_ending(path)
    picture = _picture(given.file)
    trimap, method = _trimap(given, picture)
    with _named(given.trimap or given.scribbles):
        alpha = matte(picture, trimap, given.method or method)
    write_matte(given.output, alpha)
    if given.foreground:
        write(given.foreground, cut_out(picture, alpha))


def _check_ending(path: str) -> None:
    from ..render.errors import Refused

    if not path.lower().endswith(FORMATS):
        raise Refused(f"{path}: its ending is not one of {', '.join(FORMATS)}")


def _picture(path: str):
    """The picture's colours, height x width x 3."""
    import warnings

    from ..images import read

    with warnings.catch_warnings(record=True) as said, _named(path):
        warnings.simplefilter("always")
        picture = read(path)
    sentences = [str(warning.message) for warning in said]
    if (picture[..., 3] < 1).any():
        sentences.append(f"{path}: has an alpha of its own; the matte is solved over black")
    for sentence in sentences:
        print(f"stillwater: warning: {sentence}", file=sys.stderr, flush=True)
    return picture[..., :3] * picture[..., 3:]


def _trimap(given, picture):
    """The trimap, and the method that the file asks for."""
    from .. import _stillwater as engine
    from ..matting import drawn_trimap
    from ..recipe import RecipeError
    from ..recipe.drawn import load_drawn
    from ..render.errors import Refused

    if given.trimap:
        with _named(given.trimap):
            return engine.read_matte(given.trimap, ""), "closed-form"
    try:
        drawn = load_drawn(given.scribbles)
    except RecipeError as error:
        raise Refused("\n".join(f"{given.scribbles}: {problem}" for problem in error.problems)) from None
    except OSError as error:
        gone = isinstance(error, FileNotFoundError)
        raise Refused(f"{given.scribbles}: {'there is no such file' if gone else error.strerror}") from None
    with _named(given.scribbles):
        return drawn_trimap(picture, drawn), drawn.method


@contextlib.contextmanager
def _named(path: str):
    """What is wrong with what a file holds is said with its name, once."""
    from .. import _stillwater as engine
    from ..render.errors import Refused

    try:
        yield
    except (engine.BadInput, engine.FileError) as error:
        sentence = str(error).removeprefix("trimap: ")
        raise Refused(sentence if sentence.startswith(path) else f"{path}: {sentence}") from None
