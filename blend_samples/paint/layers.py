"""From painted layers to the picture and its mattes."""

import os

import numpy as np

from .fields import blur


def over(front: np.ndarray, back: np.ndarray) -> np.ndarray:
    """Premultiplied RGBA over premultiplied RGBA, on display values."""
    return front + back * (1 - front[..., 3:])


def crisp(layer: np.ndarray, low: float = 0.12, high: float = 0.88) -> np.ndarray:
    """The layer with its coverage stretched, so that what is nearly whole is whole and thin haze is gone."""
    alpha = layer[..., 3:]
    new = np.clip((alpha - low) / (high - low), 0, 1)
    return np.concatenate([layer[..., :3] / np.maximum(alpha, 1e-4) * new, new], axis=2)


def outlined(layer: np.ndarray, guide: np.ndarray, share: float = 1.0) -> np.ndarray:
    """The layer with its coverage brought towards the guide's, wholly by share 1: for forms too thin or too soft for
    a brush's ragged edge."""
    alpha = layer[..., 3:] + share * (guide[..., 3:] - layer[..., 3:])
    return np.concatenate([layer[..., :3] / np.maximum(layer[..., 3:], 1e-4) * alpha, alpha], axis=2)


def airy(colour: np.ndarray, cover: np.ndarray) -> np.ndarray:
    """Premultiplied RGBA of what is seen (H, W, 3) through a soft outline (H, W)."""
    return np.concatenate([colour * cover[..., None], cover[..., None]], axis=2).astype(np.float32)


def room(form: np.ndarray, wide: float, gain: float, blocked: np.ndarray) -> np.ndarray:
    """The outline (H, W) of the air in which a fluid of coverage `form` may flow: wider and softer than the fluid
    itself, so that it is the fluid's own edges that are seen to move."""
    grown = np.clip(blur(form, wide) * gain, 0, 1)
    return grown * grown * (3 - 2 * grown) * (1 - blocked)


def spread_under(layer: np.ndarray) -> np.ndarray:
    """The layer with half-covered marks made whole, for what lies under the edges of others."""
    alpha = layer[..., 3:]
    new = np.clip(alpha * 1.5, 0, 1)
    return np.concatenate([layer[..., :3] / np.maximum(alpha, 1e-4) * new, new], axis=2)


def write_sample(folder: str, layers: list[tuple[str, np.ndarray]], filled: tuple = ()) -> None:
    """picture.png, mattes/NAME.png of all layers but the last, and behind/NAME.jpg of those in `filled`.

    layers: name and premultiplied display RGBA, front first, the last one whole. What is behind a layer is
    painted whole, but kept only where the layer covers it: elsewhere the file is flat, and small.
    """
    whole = layers[-1][1][..., :3]
    for name, layer in reversed(layers[:-1]):
        alpha = np.round(np.clip(layer[..., 3], 0, 1) * 255) / 255
        file = name.replace(" ", "_")
        if name in filled:
            near = (blur(alpha, 3.0) > 0.01)[..., None]
            write_image(os.path.join(folder, "behind", file + ".jpg"), np.where(near, whole, whole.mean(axis=(0, 1))))
        write_image(os.path.join(folder, "mattes", file + ".png"), alpha)
        colour = layer[..., :3] / np.maximum(layer[..., 3:], 1e-4)
        whole = np.clip(colour, 0, 1) * alpha[..., None] + whole * (1 - alpha[..., None])
    write_image(os.path.join(folder, "picture.png"), whole)


def write_image(path: str, image: np.ndarray) -> None:
    """Display values 0..1, (H, W) or (H, W, 3), as an 8-bit PNG or JPEG by the path's ending."""
    import OpenImageIO as oiio

    planes = image if image.ndim == 3 else image[..., None]
    data = np.ascontiguousarray(np.round(np.clip(planes, 0, 1) * 255).astype(np.uint8))
    os.makedirs(os.path.dirname(path), exist_ok=True)
    spec = oiio.ImageSpec(data.shape[1], data.shape[0], data.shape[2], "uint8")
    if path.endswith(".png"):
        spec.attribute("png:compressionLevel", 9)
    else:
        spec.attribute("Compression", "jpeg:90")
    out = oiio.ImageOutput.create(path)
    if out is None or not out.open(path, spec) or not out.write_image(data):
        raise OSError(f"{path} can't be written")
    out.close()
