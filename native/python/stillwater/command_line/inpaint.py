"""`stillwater inpaint PICTURE HOLE -o OUT`: a hole filled with what the rest of the picture is made of."""

import argparse
import re


def add_to(commands) -> None:
    parser = commands.add_parser("inpaint", help="fill a hole with what the rest of the picture is made of")
    parser.add_argument("file", metavar="PICTURE", help="anything OpenImageIO reads")
    parser.add_argument(
        "hole", metavar="HOLE", help="image of the picture's size; filled where it is light (half or more)"
    )
    parser.add_argument(
        "-o", "--output", required=True, metavar="OUT", help="the filled picture (.png, .jpg, .tif, .exr)"
    )
    parser.add_argument("--patch", type=int, default=9, metavar="PX", help="side of the patches compared, odd (9)")
    parser.add_argument("--radius", type=float, metavar="PX", help="how far a patch may come from (anywhere)")
    parser.add_argument("--seed", type=_seed, default=0, metavar="N", help="another seed gives another filling (0)")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from ..images import read, write
    from ..inpainting import inpaint
    from ..render.errors import Refused

    try:
        picture, hole = read(given.file), read(given.hole)
        lit = (hole[..., :3].mean(axis=2) * hole[..., 3]).round(6)
        filled = inpaint(picture, lit, patch=given.patch, radius=given.radius, seed=given.seed)
    except (ValueError, OSError) as error:
        raise Refused(str(error)) from None
    write(given.output, filled)


def _seed(text: str) -> int:
    if not re.fullmatch(r"\d{1,18}", text):
        raise argparse.ArgumentTypeError(f"{text} is not a number from 0 up")
    return int(text)
