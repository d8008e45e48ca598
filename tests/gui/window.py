"""Blender's window as a person has it: looked at through screenshots, worked with mouse and keys.

Whatever takes time is a generator: `yield from window.click("Bake")`. A `yield` lets Blender handle its events and draw
once; `yield 0.2` lets it run for that many seconds. Places are in pixels from the screen's lower left corner. Where a
file browser or a render has opened a window of its own, that one is meant.
"""

import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

import bpy
import lettering
import numpy as np

PATIENCE = 60  # s: until something has to show
SETTLED = 4  # redraws after which an input has had its effect

KEYS = dict(zip("0123456789", "ZERO ONE TWO THREE FOUR FIVE SIX SEVEN EIGHT NINE".split()))
KEYS |= {".": "PERIOD", ",": "COMMA", "-": "MINUS", "/": "SLASH", " ": "SPACE", "_": "MINUS"}


class Box(NamedTuple):
    """A rectangle of the screen."""

    x: int
    y: int
    width: int
    height: int

    @property
    def middle(self) -> tuple[int, int]:
        return self.x + self.width // 2, self.y + self.height // 2

    @property
    def top(self) -> int:
        return self.y + self.height


class Window:
    def __init__(self, screens: Path):
        """`screens` is the folder that screenshots go to."""
        self._screens = screens
        self._mouse = (0, 0)
        bpy.context.preferences.view.show_tooltips = False  # they would come and go with the machine's speed

    @property
    def plays(self) -> bool:
        """Whether the animation runs."""
        return self._window.screen.is_animation_playing

    @property
    def _window(self):
        """The newest: it lies over the others."""
        return bpy.context.window_manager.windows[-1]

    # -- looking

    def pixels(self, box: Box | None = None) -> np.ndarray:
        """What the screen shows now: H x W x 3, 0..255, rows top to bottom."""
        height = bpy.context.window_manager.windows[0].height  # fills the screen
        raw = subprocess.run(["import", "-window", "root", "-depth", "8", "rgb:-"], capture_output=True, timeout=30)
        shown = np.frombuffer(raw.stdout, np.uint8).reshape(height, -1, 3)
        if box is None:
            return shown
        return shown[height - box.y - box.height : height - box.y, box.x : box.x + box.width]

    def screenshot(self, name: str):
        """Leaves NAME.png among the screens."""
        yield from self.settle()
        path = self._screens / f"{name}.png"
        subprocess.run(["import", "-window", "root", str(path)], check=True, timeout=30)

    def cut_out(self, name: str, box: Box, share: float = 1):
        """Leaves a part of the screen, made smaller to a `share` of it, as guide/NAME.jpg among the screens."""
        yield from self.settle()
        folder = self._screens / "guide"
        folder.mkdir(exist_ok=True)
        top = bpy.context.window_manager.windows[0].height - box.y - box.height
        crop = ["-crop", f"{box.width}x{box.height}+{box.x}+{top}", "+repage", "-resize", f"{share:.0%}"]
        command = ["import", "-window", "root", *crop, "-quality", "82", str(folder / f"{name}.jpg")]
        subprocess.run(command, check=True, timeout=30)

    def area(self, kind: str):
        """The largest editor of a kind, as Blender names it ("VIEW_3D")."""
        areas = [area for area in self._window.screen.areas if area.type == kind]
        assert areas, f"no {kind} among {[area.type for area in self._window.screen.areas]}"
        return max(areas, key=lambda area: area.width * area.height)

    def has(self, kind: str) -> bool:
        """Whether the window shows an editor of this kind."""
        return any(area.type == kind for area in self._window.screen.areas)

    def box(self, kind: str, region: str = "WINDOW") -> Box:
        """Where a region of an editor is ("UI" is its sidebar)."""
        found = next(r for r in self.area(kind).regions if r.type == region)
        return Box(self._window.x + found.x, self._window.y + found.y, found.width, found.height)

    def places(self, text: str, inside: Box | None = None, turned: bool = False) -> list[tuple[int, int]]:
        """The middles of all places where `text` is to be read, best first; `turned` as on a sidebar's tabs."""
        inside = inside or Box(self._window.x, self._window.y, self._window.width, self._window.height)
        word = lettering.drawn(text)
        found = lettering.places(self.pixels(inside).mean(2), np.rot90(word, -1) if turned else word)
        return [(inside.x + x, inside.y + inside.height - 1 - y) for x, y in found]

    def see(self, text: str, inside: Box | None = None, turned: bool = False, lowest: bool = False):
        """Waits until `text` is to be read in just one place, and returns that; the `lowest` place where there are more."""
        found = []

        def unmistakable():
            found[:] = sorted(self.places(text, inside, turned), key=lambda place: place[1])
            return len(found) == 1 or (found and lowest)

        yield from self.until(unmistakable, PATIENCE, lambda: f"“{text}” is to be read in {len(found)} places: {found}")
        return found[0]

    def is_to_read(self, text: str, inside: Box | None = None) -> bool:
        """Whether `text` is on the screen now."""
        return bool(self.places(text, inside))

    def until(self, condition, seconds: float, otherwise):
        """Lets Blender run until `condition()`; fails with the sentence `otherwise` (or what it returns) after `seconds`."""
        start = time.monotonic()
        yield from self.settle()
        while not condition():
            late = time.monotonic() - start > seconds
            assert not late, f"after {seconds} s: {otherwise() if callable(otherwise) else otherwise}"
            yield 0.1

    def settle(self):
        """Lets Blender handle what came in, and draw."""
        for _ in range(SETTLED):
            yield

    # -- mouse

    def move(self, place: tuple[int, int]):
        self._mouse = place
        self._send("MOUSEMOVE", "NOTHING")
        yield

    def press(self, button: str = "LEFTMOUSE", **held: bool):
        self._send(button, "PRESS", **held)
        yield
        self._send(button, "RELEASE", **held)
        yield from self.settle()

    def click(self, what, inside: Box | None = None, beside: int = 0, ctrl: bool = False, **which: bool):
        """Clicks on a place, or on a text (see()), or `beside` pixels to the right of its middle."""
        place = what if isinstance(what, tuple) else (yield from self.see(what, inside, **which))
        yield from self.move((place[0] + beside, place[1]))
        yield  # what is under the mouse becomes active before it is pressed
        yield from self.press(ctrl=ctrl)

    def drag(self, points: list[tuple[int, int]], steps: int = 6):
        """Draws with the left button held down, in straight lines from point to point."""
        yield from self.move(points[0])
        self._send("LEFTMOUSE", "PRESS")
        yield
        for start, end in zip(points, points[1:]):
            for step in np.linspace(0, 1, steps + 1)[1:]:
                yield from self.move(tuple(round(a + (b - a) * step) for a, b in zip(start, end)))
        self._send("LEFTMOUSE", "RELEASE")
        yield from self.settle()

    def scroll_to(self, text: str, inside: Box):
        """Turns the wheel over a sidebar until `text` is to be read there: where it is not yet, from its top down."""
        if self.places(text, inside):
            return
        yield from self.move(inside.middle)
        for turn in 40 * ["WHEELUPMOUSE"]:
            self._send(turn, "PRESS")
        yield from self.settle()
        for _ in range(20):
            if self.places(text, inside):
                return
            for turn in 4 * ["WHEELDOWNMOUSE"]:
                self._send(turn, "PRESS")
            yield from self.settle()
        raise AssertionError(f"“{text}” is nowhere to be read")

    def choose(self, field: str, item: str, inside: Box, beside: int):
        """Opens the menu `beside` the label of a field, and clicks on one of its items."""
        yield from self.click(field, inside, beside=beside, lowest=True)
        yield from self.click(item, inside=self.box("VIEW_3D"), lowest=True)

    def click_button(self, operator: str, near: tuple[int, int], reach: int = 120):
        """Clicks on a button that has no text, above or below a place. `operator`: its call, `stillwater.cancel(`."""
        steps = [step for distance in range(0, reach, 8) for step in {distance, -distance}]
        yield from self.point_at(operator, [(near[0], near[1] + step) for step in steps])
        yield from self.press()

    def point_at(self, button: str, places: list[tuple[int, int]]):
        """Moves the mouse along places until it is over a button whose call or property holds `button`; returns where."""
        met = set()
        for place in places:
            yield from self.move(place)
            yield
            met |= {over := self._under_mouse()}
            if button in over:
                return place
        raise AssertionError(f"{button} is not near {places[0]}, but {sorted(met)}")

    def _under_mouse(self) -> str:
        """The call of the button under the mouse, or where its property is; empty where there is none."""
        for area in self._window.screen.areas:
            for region in area.regions:  # a sidebar lies over the main region
                x, y = self._mouse[0] - self._window.x - region.x, self._mouse[1] - self._window.y - region.y
                if 0 <= x < region.width and 0 <= y < region.height and region.type != "WINDOW":
                    with bpy.context.temp_override(window=self._window, area=area, region=region):
                        for copy in (bpy.ops.ui.copy_python_command_button, bpy.ops.ui.copy_data_path_button):
                            if copy.poll():
                                copy()
                                return bpy.context.window_manager.clipboard
        return ""

    # -- keys

    def key(self, name: str, at: tuple[int, int] | None = None, **held: bool):
        """Presses a key, as Blender names it, with `ctrl=True` and others held down; `at` moves the mouse first."""
        if at:
            yield from self.move(at)
        self._send(name, "PRESS", **held)
        yield
        self._send(name, "RELEASE", **held)
        yield from self.settle()

    def stroke(self, name: str, **held: bool):
        """Presses a key, as quickly as somebody who presses it again and again."""
        self._send(name, "PRESS", **held)
        self._send(name, "RELEASE", **held)
        yield

    def type(self, text: str):
        """Types into the field that takes letters now."""
        for letter in text:
            key = KEYS.get(letter, letter.upper())
            self._send(key, "PRESS", unicode=letter, shift=letter.isupper() or letter == "_")
            self._send(key, "RELEASE")
        yield from self.settle()

    def fill(self, what, text: str, inside: Box | None = None, beside: int = 0, **how: bool):
        """Puts `text` into the field at a place, or beside its label; ends with Enter. A list's names open by `ctrl`."""
        yield from self.click(what, inside, beside, **how)
        yield from self.key("A", ctrl=True)
        yield from self.type(text)
        yield from self.key("RET")

    def open_file(self, path: Path, button: str):
        """Types a file's path into the open file browser, and clicks on the button that ends it, where it is needed."""
        yield from self.fill(self.box("FILE_BROWSER", "UI").middle, str(path))
        yield from self.key("RET")  # what it made of the path stands in the field for the name, which takes letters now
        if self.has("FILE_BROWSER"):
            yield from self.click(button, self.box("FILE_BROWSER", "EXECUTE"))

    def save_file(self, path: Path, button: str):
        """Types folder and name of a file into the open file browser, and clicks on the button that ends it."""
        yield from self.fill(self.box("FILE_BROWSER", "UI").middle, str(path.parent))
        yield from self.key("RET")  # the field goes on taking letters
        below = self.box("FILE_BROWSER", "EXECUTE")
        yield from self.fill((below.x + below.width // 4, below.middle[1]), path.name)
        yield from self.click(button, below)

    def drop_file(self, path: Path, place: tuple[int, int]):
        """Drops a file of a file manager's at a place."""
        yield from self.move(place)
        down = bpy.context.window_manager.windows[0].height - 1 - place[1]
        command = [sys.executable, Path(__file__).with_name("drop.py"), path, str(place[0]), str(down)]
        source = subprocess.Popen(command)
        yield from self.until(lambda: source.poll() is not None, PATIENCE, "the file is still in the air")
        assert source.returncode == 0, "the window does not take it"

    def _send(self, kind: str, value: str, **more):
        window = self._window
        window.event_simulate(kind, value, x=self._mouse[0] - window.x, y=self._mouse[1] - window.y, **more)
