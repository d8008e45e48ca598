"""The one door to the engine: whether it can be imported, why not, and how its worker is started.

Nothing else in the extension says `import stillwater`. The extension registers without the engine too; its panel then
shows `problem()`.
"""

import subprocess
import sys
from pathlib import Path

from bpy.app.translations import pgettext_rpt as rpt_

TRIAL = 20  # s: how long a Python may take to load the engine
SMALL, FLOWS = 256, 16  # px: a clip's longer side where its speed is picked, and the least that has a flow
SEEN, AROUND = 4, 3  # frames, and px of them on each side of the place

_engine = None
_problem = "The engine was not looked for yet"
_caches: dict[Path, object] = {}  # by folder: they remember the hashes of files

# -I: nothing of the user's own Python gets in. The engine's folder comes first, Blender's own modules after it.
_START = """
import sys, runpy
sys.path.insert(0, {site!r})
runpy.run_module("stillwater", run_name="__main__", alter_sys=True)
"""


def load() -> None:
    """Imports the engine, or keeps the reason why that can't be."""
    global _engine, _problem
    try:
        import stillwater
        stillwater.__version__  # noqa: B018  loads the compiled part
    except ImportError as error:
        _engine, _problem = None, rpt_("The engine can't be loaded: {error}").format(error=error)
    else:
        _engine, _problem = stillwater, ""


def problem() -> str:
    """Why the engine can't be used, as a sentence; empty where it can."""
    return _problem


def version() -> str:
    """The engine's version; empty without an engine."""
    return _engine.__version__ if _engine else ""


def read_recipe(path: str) -> dict:
    """A checked recipe with every default filled in. Throws ValueError with the engine's sentences, OSError."""
    if _engine is None:
        raise ValueError(_problem)
    import msgspec

    return msgspec.to_builtins(_engine.load(path).recipe)


def parse(recipe: dict, folder: Path):
    """A recipe as a checked document. Throws ValueError with the engine's sentences."""
    if _engine is None:
        raise ValueError(_problem)
    return _engine.parse(recipe, folder)


def standing(document, read, folder: Path | None = None):
    """Looks up which frames of a document stand (the engine's render/standing.py). Throws ValueError, OSError.

    `read`: what reads a frame's mark; `folder`: of the cache, where not in the document's. Hashes of files are
    remembered as long as Blender runs.
    """
    from stillwater.render import cache, standing

    folder = folder or document.folder / cache.FOLDER
    return standing.standing(document, read=read, cache=_caches.setdefault(folder, cache.Cache(folder)))


def quick_matte(key: str, folder: Path):
    """The matte that `serve` answered with this key, H x W of the picture, bytes, top row first.

    `folder`: of the cache. None where it has it no more.
    """
    from stillwater.render import cache

    kept = _caches.setdefault(folder, cache.Cache(folder)).find(key)
    return None if kept is None else kept.arrays["matte"]


def cache_in(folder: Path) -> Path:
    """The cache's folder of a recipe whose paths start at `folder`, where no other is chosen."""
    from stillwater.render import cache

    return folder / cache.FOLDER


def forget_layers(document, folder: Path) -> None:
    """Removes from the cache in `folder` what was prepared for a document. Throws ValueError, OSError."""
    from stillwater.render import cache, preview

    preview.forget(document, cache.Cache(folder))


def read_mark(path: Path):
    """What a frame's file says that it was made from: its key, empty where it is not one of ours, and its parts."""
    from stillwater.render.reads import read_mark

    return read_mark(path)


def joined(frames: list) -> list:
    """Neighbouring frames in one state as one range."""
    from stillwater.render.standing import joined

    return joined(frames)


def by_reason(spans: list) -> dict[str, list[tuple[int, int]]]:
    """Each reason why frames are out of date, and their ranges."""
    from stillwater.render.standing import by_reason

    return by_reason(spans)


def layer_names(names: list[str]) -> list[str]:
    """Names of layers as they stand in the frames' files. Throws ValueError for an empty one or without an engine."""
    if _engine is None:
        raise ValueError(_problem)
    from stillwater import _stillwater

    return _stillwater.layer_names(names)


def worker_command(python: str = "") -> list[str]:
    """What starts `python -m stillwater` with the Python given, or the one that Blender runs.

    Throws ValueError without an engine.
    """
    if _engine is None:
        raise ValueError(_problem)
    return [python or sys.executable, "-I", "-c", _START.format(site=_site())]


def serve_command(python: str = "") -> list[str]:
    """What starts `python -m stillwater serve`. Throws ValueError without an engine."""
    return [*worker_command(python), "serve"]


def live():
    """A new stillwater.Live. Throws ValueError without an engine."""
    if _engine is None:
        raise ValueError(_problem)
    return _engine.Live()


def picture_pixels(path: Path, colour_space: str):
    """The picture in a file, height x width x 4, display-referred, straight alpha. Throws ValueError, OSError."""
    if _engine is None:
        raise ValueError(_problem)
    return _engine.read(path, colour_space)


def file_matte(path: Path, channel: str):
    """How much of each pixel a matte's file says, height x width, 0 .. 1. Throws ValueError, OSError."""
    from stillwater import _stillwater

    return _stillwater.read_matte(str(path), channel)


def clip_facts(path: Path | str):
    """A clip: its frames, fps (0 = its file does not say), width, height. Throws ValueError, OSError."""
    if _engine is None:
        raise ValueError(_problem)
    from stillwater import _stillwater

    return _stillwater.Clip(str(path))


def clip_motion(clip, first: int, place: tuple[float, float]) -> tuple[float, float]:
    """How what is around a place of a clip moves, px of the clip in a frame of it: the mean over its SEEN frames from
    `first` (counted from 1) on, taken small. `place`: px. Throws ValueError, OSError."""
    import numpy as np

    if clip.frames < 2:
        raise ValueError(rpt_("The clip has one frame only, in which nothing moves"))
    scale = min(1.0, SMALL / max(clip.width, clip.height))
    size = max(FLOWS, round(scale * clip.width)), max(FLOWS, round(scale * clip.height))
    last = min(first + SEEN - 1, clip.frames)
    frames = [clip.frame(number, *size) for number in range(min(first, last - 1), last + 1)]
    flow = np.mean([_engine.optical_flow(*pair) for pair in zip(frames, frames[1:], strict=False)], axis=0)
    x, y = (int(at * small / whole) for at, small, whole in zip(place, size, (clip.width, clip.height), strict=True))
    around = flow[max(0, y - AROUND) : y + AROUND + 1, max(0, x - AROUND) : x + AROUND + 1].reshape(-1, 2)
    if not around.size:
        raise ValueError(rpt_("Click on the clip: that place is beside it"))
    right, down = np.median(around, axis=0)
    return float(right * clip.width / size[0]), float(down * clip.height / size[1])


def painted_flow(strokes: list[dict], freeze: list[dict], refine: dict, picture, bound):
    """The flow that strokes say over a small picture, height x width x 2, px/frame; all in the picture's pixels.

    `refine`: width and amount; `bound`: the matte, or None. Throws ValueError with the engine's sentence.
    """
    size = picture.shape[1], picture.shape[0]
    painted = _engine.paint_flow(strokes, size, bound=bound, freeze=_frozen(freeze, size))
    return _engine.refine_flow(painted, picture, **refine)


def proposed_flow(kind: str, freeze: list[dict], picture, bound):
    """The flow that a small picture proposes itself, as painted_flow(). Throws ValueError."""
    size = picture.shape[1], picture.shape[0]
    proposed = _engine.propose_flow(picture, kind, bound=bound, freeze=_frozen(freeze, size))
    return proposed.orientation * proposed.speed[..., None]


def _frozen(strokes: list[dict], size: tuple[int, int]):
    """How still each pixel is held by strokes; None where there are none."""
    from stillwater import _stillwater
    import numpy as np

    masks = []
    for i, stroke in enumerate(strokes):
        points = [[*point, 1.0][:3] for point in stroke["points"]]
        masks.append(_stillwater.drawn(size, _stillwater.Stroke(points, stroke["width"]), f"freeze[{i}]"))
    return np.maximum.reduce(masks) if masks else None


def streaks(flow, strength: float):
    """Streaks along a flow; its .at(phase) is height x width x 4, premultiplied. Throws ValueError."""
    from stillwater import _stillwater

    return _stillwater.Streaks(flow, strength=strength)


def python_problem(python: str) -> str:
    """Why this Python can't run the worker, as a sentence, found by trying; empty where it can."""
    if _engine is None:
        return _problem
    program = f"import sys; sys.path.insert(0, {_site()!r}); import stillwater; print(stillwater.__version__)"
    try:
        done = subprocess.run(
            [python or sys.executable, "-I", "-c", program],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", timeout=TRIAL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return rpt_("{python}: gave no answer within {time} s; is it a Python?").format(python=python, time=TRIAL)
    except OSError as error:
        return rpt_("{python}: can't be started ({why})").format(python=python, why=error.strerror)
    if done.returncode == 0 and done.stdout.strip() == version():
        return ""
    words = (done.stderr.strip() or done.stdout.strip()).splitlines()
    mine = f"Python {sys.version_info.major}.{sys.version_info.minor}"
    sentence = rpt_("{python}: can't load the engine, which is built for {mine}").format(python=python, mine=mine)
    return sentence + (f" ({words[-1]})" if words else "")


def _site() -> str:
    """The folder that holds the engine's package."""
    return str(Path(_engine.__file__).resolve().parents[1])
