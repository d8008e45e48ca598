"""`stillwater info FILE`: what a recipe will compute, and what of it is there."""


def add_to(commands) -> None:
    parser = commands.add_parser("info", help="say what will be computed, and what is there already")
    parser.add_argument("file", help="recipe (JSON)")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from ..recipe import load
    from ..render.loop import Job, Order
    from ..render.memory import needed_bytes
    from .show import Warnings

    job = Job(load(given.file), Order())
    show = Warnings()
    for event in job.check_files():
        show(event)
    recipe, (width, height) = job.recipe, job.sources.size
    frames = range(job.first, job.last + 1)
    standing = sum(job.stands(frame, job.keys.of(frame)) for frame in frames)
    print(f"picture   {width} x {height} px")
    print(f"frames    {job.first} to {job.last}, {job.size[0]} x {job.size[1]} px, {recipe.fps:g} a second"
          f"{', looping' if recipe.loop else ''}")  # fmt: skip
    print(f"layers    {len(recipe.layers)}, front first")
    for layer in recipe.layers:
        print(f"          {layer.name}: {_what(layer)}")
    print(f"folder    {job.folder}: {standing} of {len(frames)} frames are there and up to date")
    ready = "the layers are cut" if job.stack else "the layers are not cut yet"
    print(f"cache     {job.cache.folder}: {ready}, {_megabytes(job.cache.size())} in all")
    print(f"memory    {_megabytes(needed_bytes(job))}")


def _what(layer) -> str:
    words = [layer.motion.__struct_config__.tag]
    if layer.follows is not None:
        words.append(f"follows {layer.follows.layer}{' in the mirror' if layer.follows.mirror else ''}")
    if not layer.visible:
        words.append("hidden")
    return ", ".join(words)


def _megabytes(count: int) -> str:
    return f"{count / 1e6:.0f} MB"
