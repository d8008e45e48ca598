"""What the scene's animation makes of its properties, frame by frame.

Plain F-curves are evaluated (1,000 frames of 30 curves: 14 ms). A driver's curve ignores its expression, and strips of
the NLA blend: where there are any, the scene goes through its frames.
"""

from collections.abc import Iterable


class Animation:
    """The animated properties under one path of a scene, for each of `frames`."""

    def __init__(self, scene, prefix: str, frames: range, curves: Iterable, stripped: Iterable[str] = ()):
        """`curves`: F-curves of the scene's action; `stripped`: paths that strips of the NLA animate."""
        self.frames = frames
        self._values = {
            (curve.data_path, curve.array_index): [curve.evaluate(frame) for frame in frames]
            for curve in curves
            if curve.data_path.startswith(prefix) and not curve.mute
        }
        drivers = scene.animation_data.drivers if scene.animation_data else ()
        driven = {driver.data_path for driver in drivers if not driver.mute} | set(stripped)
        self._play(scene, sorted(path for path in driven if path.startswith(prefix)))

    def values(self, path: str, index: int = 0) -> list[float] | None:
        """The values of one property, one a frame; None where nothing animates it."""
        return self._values.get((path, index))

    def _play(self, scene, paths: list[str]) -> None:
        if not paths:
            return
        scene.update_tag()  # drivers do not know yet what a script has set
        now, between = scene.frame_current, scene.frame_subframe
        seen = {path: [] for path in paths}
        try:
            for frame in self.frames:
                scene.frame_set(frame)
                for path in paths:
                    value = scene.path_resolve(path)
                    seen[path].append(tuple(value) if hasattr(value, "__len__") else (value,))
        finally:
            scene.frame_set(now, subframe=between)
        for path, values in seen.items():
            for index, column in enumerate(zip(*values, strict=True)):
                self._values[path, index] = list(column)
