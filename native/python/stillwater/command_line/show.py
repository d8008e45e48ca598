"""What happens while frames are rendered, for whoever watches: JSON lines, a bar, or warnings alone."""

import contextlib
import sys

from ..render.events import Error, Event, Frame, Preparing, Started, Warn


@contextlib.contextmanager
def shown(how: str):
    """A function that shows an event; errors that end the work are shown too, and go on to whoever called."""
    show = {"json": Lines, "bar": Bar, "none": Warnings}[how]()
    try:
        yield show
    except BrokenPipeError:
        raise
    except Exception as error:
        show(Error(sentence_of(error)))
        raise
    finally:
        show.end()


def sentence_of(error: Exception) -> str:
    """What an error says, in one line."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return "; ".join(str(error).splitlines()) or type(error).__name__


class Warnings:
    """Warnings on standard error, nothing else."""

    def __call__(self, event: Event) -> None:
        if isinstance(event, Warn):
            print(f"stillwater: warning: {event.sentence}", file=sys.stderr, flush=True)

    def end(self) -> None:
        pass


class Lines:
    """Every event as one line of JSON on standard output."""

    def __call__(self, event: Event) -> None:
        import msgspec

        sys.stdout.write(msgspec.json.encode(event).decode() + "\n")
        sys.stdout.flush()

    def end(self) -> None:
        pass


class Bar:
    """A bar on standard error, warnings above it."""

    def __init__(self):
        self._bar = None

    def __call__(self, event: Event) -> None:
        from tqdm import tqdm

        match event:
            case Started():
                tqdm.monitor_interval = 0  # no thread
                self._bar = tqdm(total=event.of, unit="frame", desc=event.folder, dynamic_ncols=True)
            case Preparing():
                self._bar.set_postfix_str(f"{event.what} ({event.share:.0%})" if event.share < 1 else "")
            case Frame():
                self._bar.update()
            case Warn():
                tqdm.write(f"stillwater: warning: {event.sentence}", file=sys.stderr)

    def end(self) -> None:
        if self._bar is not None:
            self._bar.close()
