"""The loop over frames: what stands already is kept, what is missing is rendered. What happens comes as events."""

import contextlib
import errno
import math
import shutil
import time
from collections.abc import Generator, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import _stillwater as engine
from ..recipe import Document, Recipe, RecipeError
from .cache import FOLDER, LIMIT, Cache, Prepared
from .claim import claim_frames
from .errors import Failed, Refused
from .events import Done, Event, Frame, Preparing, Started, Warn
from .keys import FrameKeys
from .lock import Lock
from .movie import Movie
from .prepare import LARGEST_SIDE, Sources, boxes_of, check_view
from .reads import Reads, mark, read_mark
from .ready import Canvas, make_ready
from .renderer import Renderer, eight_bit
from .resolve import Timeline
from .stack import cut, find_stack


@dataclass(frozen=True)
class Order:
    """What to render of a recipe. None: as the recipe says."""

    frames: tuple[int, int] | None = None  # first, last
    folder: Path | None = None
    scale: float | None = None  # output pixels for a picture pixel
    movie: Path | None = None
    fresh: bool = False  # render anew what stands already
    cache: Path | None = None  # folder of the cache; None: beside the recipe
    cache_limit: int | None = None  # bytes; None: cache.py's


class Job:
    """A recipe and an order, looked through: every file is read or known, nothing is written yet.

    Throws RecipeError and Refused with all that is wrong.
    """

    def __init__(self, document: Document, order: Order):
        recipe = document.recipe
        self.document, self.recipe, self.order = document, recipe, order
        self.first, self.last = frame_range(recipe, order)
        self.scale = recipe.output.scale if order.scale is None else order.scale
        self.folder = order.folder or document.locate(recipe.output.folder)
        self.timeline = Timeline(recipe)
        self.cache = Cache(order.cache or document.folder / FOLDER, order.cache_limit or LIMIT)
        self.sources = Sources(document, self.cache)
        self.size = frame_size(self.sources.size, self.scale)
        self.keys = FrameKeys(self.timeline, self.sources.key, self.sources.size, self.scale, self.sources.digests)
        self.reads = Reads(self.timeline, self.sources.digests, self.keys.fixed)
        self.stack: Prepared | None = None if order.fresh else find_stack(self.cache, self.sources.key)
        self.images = None
        self.boxes: list = []  # of the layers in the picture; check_files() finds them
        self.has_alpha = False

    def check_files(self) -> Iterator[Event]:
        """Reads the files, where the cache has not what they gave; warns of what is odd in them."""
        if self.stack is None:
            self.images = yield from self.sources.read()
            said, self.boxes, self.has_alpha = self.images.warnings, boxes_of(self.images), self.images.has_alpha
        else:
            said, self.boxes, self.has_alpha = (self.stack.facts[name] for name in ("warnings", "colour", "has_alpha"))
        check_view(self.recipe, self.boxes)
        yield from map(Warn, [*said, *self.timeline.warnings()])

    def prepare(self, claim) -> Iterator[Event]:
        """Leaves the layers in `stack`: from the cache, from another worker that is at it, or cut now."""
        if self.stack is not None:
            return
        with self.cache.lock(self.sources.key, claim.beat) as beat:
            if not self.order.fresh:
                self.stack = find_stack(self.cache, self.sources.key)
            if self.stack is None:
                self.stack = yield from cut(self.sources, self.images, self.cache, beat, self.order.fresh)
        self.images = None

    def ready(self, claim) -> Generator[Event, None, Renderer]:
        """The renderer, when the layers are there and those that drift or flow endless."""
        fresh = self.stack is None
        yield from self.prepare(claim)
        canvas = Canvas(self.sources.key, self.stack, self.sources.size, self.scale)
        ready = yield from make_ready(
            canvas, self.timeline, self.document, self.sources.digests, self.cache, canvas.key, claim.beat
        )
        if fresh:
            yield Preparing(1, "done")
        self.stack = None  # the renderer has a copy
        return Renderer(self.timeline, canvas, ready)

    def path(self, frame: int) -> Path:
        return self.folder / f"{self.recipe.output.name}_{frame:04d}.exr"

    def stands(self, frame: int, key: str) -> bool:
        """Whether the frame's file is there and all that it reads is as it was."""
        path = self.path(frame)
        return path.exists() and read_mark(path)[0] == key

    def write(self, frame: int, made, key: str) -> None:
        output = self.recipe.output
        kept = mark(key, self.reads.of(frame))
        try:
            engine.write_frame(
                str(self.path(frame)),
                made.combined,
                made.flow,
                made.matte,
                layers=self._own_layers(made) if output.layers else [],
                options=engine.FrameOptions(half=output.depth == "half", compression=output.compression, key=kept),
            )
        except engine.FileError as error:
            left = shutil.disk_usage(self.folder).free
            full = left < made.combined.nbytes
            why = f"{self.path(frame)}: cannot be written: the disk is full ({left} bytes left)" if full else str(error)
            raise Failed(why) from None

    def _own_layers(self, made) -> list[tuple[str, np.ndarray]]:
        """The layers that are not hidden, each alone; one that covers nothing is None in the engine's answer."""
        nothing = np.zeros_like(made.combined)
        layers = zip(self.recipe.layers, made.layers, strict=True)
        return [(layer.name, nothing if picture is None else picture) for layer, picture in layers if layer.visible]


def render(document: Document, order: Order) -> Iterator[Event]:
    """Renders; every frame that is there is an event.

    Throws RecipeError (recipe or files wrong) and Refused before anything is written, Failed later. What is finished
    stays, and the next run goes on from there.
    """
    began = time.perf_counter()
    movie = Movie(order.movie) if order.movie else None
    job = Job(document, order)
    of = job.last - job.first + 1
    yield Started(job.first, job.last, of, job.size, str(job.folder))
    yield from job.check_files()
    with _claim(job) as claim:
        engine.sweep_temporaries(str(job.folder))
        job.cache.sweep()
        rendered = yield from _frames(job, movie, claim)
        job.cache.keep_digests()
    if job.cache.trouble:
        yield Warn(job.cache.trouble)
    yield Done(rendered, of - rendered, round(time.perf_counter() - began, 3), str(movie.path) if movie else None)


def _frames(job: Job, movie: Movie | None, claim: Lock) -> Generator[Event, None, int]:
    """Frame after frame; answers how many were rendered."""
    of, renderer, rendered = job.last - job.first + 1, None, 0
    if movie:
        movie.begin(job.size, job.recipe.fps)
    for frame in range(job.first, job.last + 1):
        claim.beat()
        start, made = time.perf_counter(), None  # the frame before is given up first
        key = job.keys.of(frame)
        kept = not job.order.fresh and job.stands(frame, key)
        if not kept:
            if renderer is None:
                renderer = yield from job.ready(claim)
                start = time.perf_counter()
            made = renderer.frame(frame)
            job.write(frame, made, key)
            rendered += 1
        if movie:
            movie.add(eight_bit(engine.read_frame(str(job.path(frame))) if kept else made.combined))
        yield Frame(frame, of, round(time.perf_counter() - start, 4), str(job.path(frame)), kept)
    if movie:
        movie.end()
    return rendered


@contextlib.contextmanager
def _claim(job: Job) -> Iterator[Lock]:
    """Makes the output folder and claims the frames in it. Where only then something turns out to be wrong, it is not left."""
    there = job.folder.exists()
    try:
        job.folder.mkdir(parents=True, exist_ok=True)
        claim = claim_frames(job.folder, job.recipe.output.name, job.first, job.last)
    except OSError as error:
        sentence = f"output.folder: {job.folder}: cannot be written ({error.strerror})"
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            raise Failed(sentence) from None
        raise Refused(sentence) from None
    try:
        with claim:
            yield claim
    except RecipeError:
        if not there:
            with contextlib.suppress(OSError):  # frames of another worker are in it
                job.folder.rmdir()
        raise


def frame_range(recipe: Recipe, order: Order) -> tuple[int, int]:
    """First and last frame to render. Throws Refused where the recipe has them not."""
    first, last = recipe.frames if order.frames is None else order.frames
    if first > last:
        raise Refused(f"--frames: {first}-{last} runs backwards (the first is not above the last)")
    if first < recipe.frames[0] or last > recipe.frames[1]:
        raise Refused(f"--frames: {first}-{last} is not within the recipe's {recipe.frames[0]}-{recipe.frames[1]}")
    return first, last


def frame_size(picture: tuple[int, int], scale: float) -> tuple[int, int]:
    """Width and height of a frame, pixels. Throws Refused where one is too large."""
    width, height = (max(1, math.floor(side * scale + 0.5)) for side in picture)
    if max(width, height) > LARGEST_SIDE:
        raise Refused(f"scale: {scale:g} makes frames of {width} x {height}, not of at most {LARGEST_SIDE} px a side")
    return width, height
