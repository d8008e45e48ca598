"""Drops a file onto a window, as a file manager does: the source's side of XDND, freedesktop.org's drag-and-drop protocol.

    python3 drop.py FILE X Y          place on the screen, from its upper left corner

Ends with code 0 once the window says that it has taken the file.
"""

import select
import sys
import time
from pathlib import Path

from Xlib import X, Xatom, display
from Xlib.protocol import event

VERSION = 5
PATIENCE = 20  # s
KIND = "text/uri-list"


class Source:
    """The window that something is dragged from."""

    def __init__(self, path: Path, place: tuple[int, int]):
        self.display = display.Display()
        self.place, self.words = place, f"{path.resolve().as_uri()}\r\n".encode()
        root = self.display.screen().root
        self.window = root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        self.target = self._aware(root)
        self.window.set_selection_owner(self._atom("XdndSelection"), X.CurrentTime)
        root.warp_pointer(*place)

    def drop(self) -> None:
        """The whole way. Throws TimeoutError where the target does not answer."""
        self._tell("XdndEnter", VERSION << 24, self._atom(KIND), 0, 0)
        for _ in range(2):  # over the window, and on its way
            self._tell("XdndPosition", 0, self.place[0] << 16 | self.place[1], X.CurrentTime, self._atom("XdndActionCopy"))
            self._wait_for("XdndStatus")
        self._tell("XdndDrop", 0, X.CurrentTime, 0, 0)
        self._wait_for("XdndFinished")

    def _atom(self, name: str) -> int:
        return self.display.intern_atom(name)

    def _aware(self, root):
        """The window at the place that takes drops."""
        for window in reversed(root.query_tree().children):
            box = window.get_geometry()
            inside = 0 <= self.place[0] - box.x < box.width and 0 <= self.place[1] - box.y < box.height
            if inside and window.get_full_property(self._atom("XdndAware"), X.AnyPropertyType):
                return window
        sys.exit("no window there takes drops")

    def _tell(self, name: str, *words: int) -> None:
        said = event.ClientMessage(window=self.target, client_type=self._atom(name), data=(32, (self.window.id, *words)))
        self.target.send_event(said)
        self.display.flush()

    def _wait_for(self, name: str) -> None:
        """Until the target says so; meanwhile it is given what it asks for."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if not self.display.pending_events():
                select.select([self.display], [], [], 0.1)
                continue
            came = self.display.next_event()
            if came.type == X.SelectionRequest:
                self._give(came)
            elif came.type == X.ClientMessage and came.client_type == self._atom(name):
                return
        raise TimeoutError(f"no {name} after {PATIENCE} s")

    def _give(self, asked) -> None:
        if asked.target == self._atom("TARGETS"):
            asked.requestor.change_property(asked.property, Xatom.ATOM, 32, [self._atom(KIND)])
        else:
            asked.requestor.change_property(asked.property, asked.target, 8, self.words)
        asked.requestor.send_event(
            event.SelectionNotify(
                time=asked.time, requestor=asked.requestor, selection=asked.selection, target=asked.target,
                property=asked.property,
            )
        )
        self.display.flush()


if __name__ == "__main__":
    Source(Path(sys.argv[1]), (int(sys.argv[2]), int(sys.argv[3]))).drop()
