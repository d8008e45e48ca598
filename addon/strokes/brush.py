"""What a stroke along which something flows says of itself: its speed, its weight, whether it is local.

Blender's brush knows nothing of it. A stroke that was just drawn is stamped with the numbers of its layer once the pen is
up, and keeps them; until then it counts as if it had them. They are attributes of a curve, `FLAGS` says whether they are there.
"""

import numpy as np

from . import gp_layers, roles

FLAGS, SPEED, ALPHA = "stillwater_flow", "stillwater_speed", "stillwater_alpha"
SAID, LOCAL = 1, 2  # of FLAGS
DIGITS = 3


def of_layer(flow) -> dict:
    """What the next stroke of a layer will say, as a recipe has it; `flow`: the numbers of its motion."""
    return {
        "speed": round(flow.stroke_speed, DIGITS), "local": flow.stroke_local, "alpha": round(flow.stroke_alpha, DIGITS),
    }  # fmt: skip


def of_curves(drawing, count: int) -> list[dict | None]:
    """What each curve of a drawing says; None where it was not stamped yet."""
    if FLAGS not in drawing.attributes:
        return [None] * count
    flags, speeds, alphas = _numbers(drawing, count)
    return [
        {"speed": round(float(speed), DIGITS), "local": bool(flag & LOCAL), "alpha": round(float(alpha), DIGITS)}
        if flag & SAID else None
        for flag, speed, alpha in zip(flags, speeds, alphas, strict=True)
    ]  # fmt: skip


def stamp(picture, layer) -> int:
    """Gives all strokes of a layer that have no numbers yet those of the layer; returns how many there were."""
    said, count = of_layer(layer.motion.flow), 0
    for role in [role for role in roles.ROLES if role.brushed]:
        for part in gp_layers.of(picture, layer.id, role):
            for key in part.frames:
                curves = key.drawing.attributes.domain_size("CURVE")
                flags = _numbers(key.drawing, curves)[0] if FLAGS in key.drawing.attributes else np.zeros(curves, int)
                fresh = np.flatnonzero(flags == 0)
                if fresh.size:
                    write(key.drawing, fresh, [said] * fresh.size)
                    count += fresh.size
    return count


def write(drawing, curves, said: list[dict]) -> None:
    """Stores what some curves of a drawing say; a clone target has nothing but its weight."""
    count = drawing.attributes.domain_size("CURVE")
    for name, kind in ((FLAGS, "INT"), (SPEED, "FLOAT"), (ALPHA, "FLOAT")):
        if name not in drawing.attributes:
            drawing.attributes.new(name, kind, "CURVE")
    flags, speeds, alphas = _numbers(drawing, count)
    for i, each in zip(curves, said, strict=True):
        flags[i], speeds[i], alphas[i] = SAID | LOCAL * each.get("local", False), each.get("speed", 0), each["alpha"]
    for name, values in ((FLAGS, flags), (SPEED, speeds), (ALPHA, alphas)):
        drawing.attributes[name].data.foreach_set("value", values)


def _numbers(drawing, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    found = []
    for name, kind in ((FLAGS, np.int32), (SPEED, np.float32), (ALPHA, np.float32)):
        values = np.zeros(count, kind)
        if count:
            drawing.attributes[name].data.foreach_get("value", values)
        found.append(values)
    return tuple(found)


def scale_speeds(picture, factor: float) -> None:
    """Multiplies the speed of every stroke: the picture has another size."""
    for part, role in gp_layers.all_of(picture):
        for key in part.frames if role.brushed else ():
            count = key.drawing.attributes.domain_size("CURVE")
            said = of_curves(key.drawing, count)
            known = [i for i in range(count) if said[i] is not None]
            if known:
                write(key.drawing, known, [{**said[i], "speed": said[i]["speed"] * factor} for i in known])
