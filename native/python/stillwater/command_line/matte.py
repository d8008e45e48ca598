"""`stillwater matte PICTURE -o ALPHA`: what scribbles, an outline or a trimap cut out of a picture."""

from .files import check_ending, drawing, named, read_picture, warn

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
        check_ending(path, FORMATS)
    picture = _picture(given.file)
    trimap, method = _trimap(given, picture)
    with named(given.trimap or given.scribbles):
        alpha = matte(picture, trimap, given.method or method)
    write_matte(given.output, alpha)
    if given.foreground:
        write(given.foreground, cut_out(picture, alpha))


def _picture(path: str):
    """The picture's colours, height x width x 3."""
    picture, sentences = read_picture(path)
    if (picture[..., 3] < 1).any():
        sentences.append(f"{path}: has an alpha of its own; the matte is solved over black")
    warn(sentences)
    return picture[..., :3] * picture[..., 3:]


def _trimap(given, picture):
    """The trimap, and the method that the file asks for."""
    from .. import _stillwater as engine
    from ..matting import drawn_trimap
    from ..recipe.drawn import load_drawn

    if given.trimap:
        with named(given.trimap):
            return engine.read_matte(given.trimap, ""), "closed-form"
    with drawing(given.scribbles):
        drawn = load_drawn(given.scribbles)
    with named(given.scribbles):
        return drawn_trimap(picture, drawn), drawn.method
