"""What the engine says, as an artist reads it."""

import re


def named(sentence: str, layers: list[str]) -> str:
    """A sentence with the layers' names for their places, layers[0] and the like; `layers`: their names, front first."""

    def name(place: re.Match) -> str:
        index = int(place[1])
        return f"{layers[index]}, " if index < len(layers) else place[0]

    return re.sub(r"layers\[(\d+)\]\.?", name, sentence)
