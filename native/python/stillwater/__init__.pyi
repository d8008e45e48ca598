import numpy as np
from numpy.typing import ArrayLike, NDArray

from .recipe import Document as Document
from .recipe import RecipeError as RecipeError
from .recipe import load as load
from .recipe import parse as parse

__version__: str

class BadInput(ValueError): ...
class FileError(OSError): ...
class Cancelled(RuntimeError): ...
class NotConverged(RuntimeError): ...

class Wind:
    speed: float
    direction: float
    gusts: float
    gust_size: float
    seed: int
    def __init__(
        self, speed: float = 5, direction: float = 0, gusts: float = 0, gust_size: float = 0.25, seed: int = 0
    ) -> None: ...
    def series(
        self, seconds: ArrayLike, *, seed: int = 0, loop_seconds: float | None = None
    ) -> NDArray[np.float64]: ...
    def gust(
        self,
        place: tuple[float, float],
        size: tuple[int, int],
        frame: float,
        *,
        fps: float = 24,
        loop: int | None = None,
    ) -> float: ...

def sway(
    size: tuple[int, int],
    frame: float,
    armature: tuple[tuple[float, float], tuple[float, float]],
    *,
    wind: Wind | None = None,
    fps: float = 24,
    loop: int | None = None,
    frequency: float = 0.6,
    mass: float = 1.0,
    damping: float = 0.4,
    amount: float = 1.0,
    foreshortening: float = 0.0,
    shimmer: float = 0.0,
    seed: int = 0,
    forward: bool = False,
) -> NDArray[np.float32]: ...
def drift(
    size: tuple[int, int],
    frame: float,
    *,
    velocity: tuple[float, float] | None = None,
    wind: float = 0.5,
    under: Wind | None = None,
    forward: bool = False,
) -> NDArray[np.float32]: ...

class Ripple:
    amplitude: float
    roughness: float
    tile: float
    resolution: int
    mode: str
    spectrum: str
    fetch: float
    depth: float
    seed: int
    def __init__(
        self,
        amplitude: float = 1.0,
        roughness: float = 1.0,
        tile: float = 60.0,
        resolution: int = 256,
        mode: str = "height",
        spectrum: str = "phillips",
        fetch: float = 100.0,
        depth: float = 200.0,
        seed: int = 0,
    ) -> None: ...

def ripple(
    size: tuple[int, int],
    frame: float,
    horizon: tuple[tuple[float, float], tuple[float, float]],
    *,
    fov: float = 50,
    height: float = 1.7,
    wind: Wind | None = None,
    fps: float = 24,
    loop: int | None = None,
    amplitude: float = 1.0,
    roughness: float = 1.0,
    tile: float = 60.0,
    resolution: int = 256,
    mode: str = "height",
    spectrum: str = "phillips",
    fetch: float = 100.0,
    depth: float = 200.0,
    seed: int = 0,
    forward: bool = False,
) -> NDArray[np.float32]: ...
def wave_heights(
    seconds: float,
    *,
    tile: float = 60.0,
    resolution: int = 256,
    spectrum: str = "phillips",
    fetch: float = 100.0,
    depth: float = 200.0,
    seed: int = 0,
    wind: Wind | None = None,
    loop_seconds: float | None = None,
) -> NDArray[np.float32]: ...
def bob(
    size: tuple[int, int],
    frame: float,
    waterline: list[tuple[float, float]],
    horizon: tuple[tuple[float, float], tuple[float, float]],
    *,
    water: Ripple | None = None,
    fov: float = 50,
    height: float = 1.7,
    wind: Wind | None = None,
    fps: float = 24,
    loop: int | None = None,
    amount: float = 1.0,
    forward: bool = False,
) -> NDArray[np.float32]: ...
