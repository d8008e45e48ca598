"""Which worker renders which frames of a folder: each claims its range before it starts, none may meet another's."""

import os
import re
from pathlib import Path

from .errors import Refused
from .lock import Lock, holder

_CLAIM = re.compile(r"^\.(?P<name>.+)\.(?P<first>-?\d+)\.\.(?P<last>-?\d+)\.(?P<worker>\d+)\.claim$")


def claim_frames(folder: Path, name: str, first: int, last: int) -> Lock:
    """Claims the frames `first` .. `last` called `name` in `folder`, until the answer is released.

    Throws Refused where a living worker has any of them, OSError where the folder can't be written.
    """
    claim = Lock(folder / f".{name}.{first}..{last}.{os.getpid()}.claim")
    door = Lock(folder / ".claiming")
    door.wait()
    with door:
        for path in sorted(folder.glob(".*.claim")):
            other = _CLAIM.match(path.name)
            if not other or other["name"] != name:
                continue
            worker = holder(path)
            if worker is None:
                path.unlink(missing_ok=True)
            elif max(first, int(other["first"])) <= min(last, int(other["last"])):
                raise Refused(
                    f"{folder}: another worker ({worker}) is rendering the frames {other['first']} to {other['last']}"
                    f" (wait for it, or give --frames that it has not)"
                )
        claim.take()
    return claim
