"""Which parts of the recipe have an engine. Who builds one, adds it here."""

from collections.abc import Iterator

from .fluids import Example, Flow
from .picture import Layer
from .stochastic import Bob, Drift, Ripple, Still, Sway

MOTIONS = (Still, Sway, Ripple, Bob, Drift, Flow, Example)


def without_engine(layer: Layer, place: str) -> Iterator[str]:
    """A sentence for each part of a layer that can't be rendered yet."""
    if not isinstance(layer.motion, MOTIONS):
        ready = ", ".join(kind.__struct_config__.tag for kind in MOTIONS)
        yield f'{place}.motion.type: "{layer.motion.__struct_config__.tag}" has no engine yet (these have: {ready})'
