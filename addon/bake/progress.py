"""What a worker's events say about its bake. Knows nothing of Blender."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from .worker import ending


@dataclass
class Progress:
    """The state of one bake; `take` and `end` change it."""

    state: str = "running"
    share: float = 0.0
    message: str = ""
    warnings: list[str] = field(default_factory=list)
    frames: int = 0
    of: int = 0
    rendered: int = 0
    seconds: float = 0.0  # that the rendered frames took
    last: float = 0.0  # when the last frame came, by `now`
    cancelled: bool = False
    layers: list[str] = field(default_factory=list)  # their names, for the sentences that speak of layers[0]
    now: Callable[[], float] = time.monotonic
    said: Callable[[str], str] = str  # puts sentences into the person's language

    def __post_init__(self):
        self.message = self.message or self.said("Starting")

    def take(self, event: dict) -> None:
        """Reads one event. Events of a kind that is not known are passed over: a newer engine may have more."""
        match event:
            case {"event": "preparing", "share": float() | int() as share}:
                what = event.get("what")
                sentence = self.said("Preparing {what}, {share:.0%}") if what else self.said("Preparing, {share:.0%}")
                self.message = sentence.format(what=what, share=share)
            case {"event": "frame", "of": int() as of}:
                self.frames, self.of = self.frames + 1, of
                self.share = min(1.0, self.frames / max(of, 1))
                self.last = self.now()
                if not event.get("kept"):
                    self.rendered += 1
                    self.seconds += seconds if isinstance(seconds := event.get("seconds"), int | float) else 0
                self.message = self.said("Frame {count} of {of}").format(count=self.frames, of=of)
            case {"event": "warning", "sentence": str() as message}:
                self.warnings.append(message)
            case {"event": "error", "sentence": str() as message}:
                self.state, self.message = "failed", message

    def left(self) -> str:
        """How long it will still take, in words; empty while that can't be said."""
        if self.state != "running" or self.cancelled or not self.rendered or self.frames >= self.of:
            return ""
        seconds = self.seconds / self.rendered * (self.of - self.frames) - (self.now() - self.last)
        return self.said("{time} left").format(time=duration(max(seconds, 0)))

    def end(self, code: int, words: str) -> None:
        """The worker has ended with `code`; `words` is the last it said in no event."""
        if self.cancelled:
            self.state, self.message = "cancelled", self._cancelled()
        elif self.state == "failed":
            return
        elif code == 0:
            self.state, self.share, self.message = "done", 1.0, self._done()
        else:
            self.state, self.message = "failed", ending(code, words, self.said)

    def _cancelled(self) -> str:
        one = self.frames == 1
        sentence = self.said("Cancelled after 1 frame") if one else self.said("Cancelled after {count} frames")
        return sentence.format(count=self.frames)

    def _done(self) -> str:
        kept = self.frames - self.rendered
        sentence = self.said("Baked 1 frame") if self.rendered == 1 else self.said("Baked {count} frames")
        done = sentence.format(count=self.rendered)
        if not kept:
            return done
        one, several = self.said("{done}, 1 was right already"), self.said("{done}, {kept} were right already")
        return (one if kept == 1 else several).format(done=done, kept=kept)


def duration(seconds: float) -> str:
    """A time as people say it: 40 s, 3 min, 1 h 20 min."""
    if seconds < 60:
        return f"{max(1, round(seconds))} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"

