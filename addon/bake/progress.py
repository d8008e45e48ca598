"""What a worker's events say about its bake. Knows nothing of Blender."""

from dataclasses import dataclass, field

from .worker import ending


@dataclass
class Progress:
    """The state of one bake; `take` and `end` change it."""

    state: str = "running"
    share: float = 0.0
    message: str = "Starting"
    warnings: list[str] = field(default_factory=list)
    frames: int = 0
    cancelled: bool = False

    def take(self, event: dict) -> None:
        """Reads one event. Events of a kind that is not known are passed over: a newer engine may have more."""
        match event:
            case {"event": "preparing", "share": float() | int() as share}:
                self.message = f"Preparing {event.get('what') or ''}".strip() + f", {share:.0%}"
            case {"event": "frame", "frame": int() as frame, "of": int() as of}:
                self.frames += 1
                self.share = min(1.0, self.frames / max(of, 1))
                self.message = f"Frame {frame}, {self.frames} of {of}"
            case {"event": "warning", "sentence": str() as message}:
                self.warnings.append(message)
            case {"event": "error", "sentence": str() as message}:
                self.state, self.message = "failed", message

    def end(self, code: int, words: str) -> None:
        """The worker has ended with `code`; `words` is the last it said in no event."""
        if self.cancelled:
            self.state, self.message = "cancelled", f"Cancelled after {_counted(self.frames)}"
        elif self.state == "failed":
            return
        elif code == 0:
            self.state, self.share, self.message = "done", 1.0, f"Baked {_counted(self.frames)}"
        else:
            self.state, self.message = "failed", ending(code, words)


def _counted(frames: int) -> str:
    return "1 frame" if frames == 1 else f"{frames} frames"
