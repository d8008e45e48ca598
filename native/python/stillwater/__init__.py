"""Stillwater brings still pictures to life. The engine, without Blender.

Names are loaded when they are first used: `import stillwater` costs nothing, and the command line can catch an
interrupt before the engine's libraries are in memory.
"""

from importlib import import_module

# Public name -> the module that has it. Whoever adds a public function adds it here and in __init__.pyi.
_HOMES = {
    "__version__": "_stillwater",
    "BadInput": "_stillwater",
    "FileError": "_stillwater",
    "Cancelled": "_stillwater",
    "NotConverged": "_stillwater",
    "Document": "recipe",
    "RecipeError": "recipe",
    "load": "recipe",
    "parse": "recipe",
    "displace": "layers",
    "over": "layers",
    "trimap": "matting",
    "matte": "matting",
    "foreground": "matting",
    "inpaint": "inpainting",
    "make_cyclic": "inpainting",
    "peel": "peeling",
    "Wind": "motion",
    "drift": "motion",
    "sway": "motion",
    "read": "images",
    "write": "images",
    "read_clip": "images",
    "read_flow": "images",
    "write_flow": "images",
    "srgb_to_linear": "images",
    "linear_to_srgb": "images",
    "Ripple": "motion",
    "bob": "motion",
    "ripple": "motion",
    "wave_heights": "motion",
    "advect": "flow",
    "flow_map": "flow",
    "Live": "render.live",
    "paint_flow": "flow_painting",
    "propose_flow": "flow_painting",
    "refine_flow": "flow_painting",
    "streaks": "flow_painting",
    "steerable_pyramid": "appearance",
    "collapse_pyramid": "appearance",
    "match_histogram": "appearance",
    "match_texture": "appearance",
    "motion_blur": "appearance",
    "optical_flow": "flow",
    "ClipAnalysis": "example",
    "analyse": "example",
    "reconstruct": "example",
    "read_analysis": "example",
    "write_analysis": "example",
}

__all__ = sorted(_HOMES)


def __getattr__(name):
    if name not in _HOMES:
        raise AttributeError(f"module 'stillwater' has no attribute {name!r}")
    return getattr(import_module(f".{_HOMES[name]}", __name__), name)


def __dir__():
    return sorted({*globals(), *_HOMES})
