"""`stillwater info FILE`: what a recipe will compute, and what of it is there."""


def add_to(commands) -> None:
    parser = commands.add_parser("info", help="say what will be computed, and what is there already")
    parser.add_argument("file", help="recipe (JSON)")
    parser.add_argument("--json", action="store_true", help="the same as one line of JSON")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from ..recipe import load
    from ..render.loop import Job, Order
    from ..render.standing import Standing, joined
    from .show import Warnings

    job = Job(load(given.file), Order())
    show = Warnings()
    for event in job.check_files():
        show(event)
    looked = Standing(job.first, job.last, job.folder, job.recipe.output.name, job.keys, job.reads)
    (_say_as_json if given.json else _say)(job, joined(looked.all()))


def _say(job, spans: list) -> None:
    from ..render.memory import needed_bytes
    from ..render.standing import READY, by_reason

    recipe, (width, height) = job.recipe, job.sources.size
    ready = sum(span.last - span.first + 1 for span in spans if span.state == READY)
    print(f"picture   {width} x {height} px")
    print(f"frames    {job.first} to {job.last}, {job.size[0]} x {job.size[1]} px, {recipe.fps:g} a second"
          f"{', looping' if recipe.loop else ''}")  # fmt: skip
    print(f"layers    {len(recipe.layers)}, front first")
    for layer in recipe.layers:
        print(f"          {layer.name}: {_what(layer)}")
    print(f"folder    {job.folder}: {ready} of {job.last - job.first + 1} frames are there and up to date")
    for clause, ranges in by_reason(spans).items():
        print(f"stale     {clause}: {', '.join(_range(*ends) for ends in ranges)}")
    cut = "the layers are cut" if job.stack else "the layers are not cut yet"
    print(f"cache     {job.cache.folder}: {cut}, {_megabytes(job.cache.size())} in all")
    print(f"memory    {_megabytes(needed_bytes(job))}")


def _say_as_json(job, spans: list) -> None:
    import msgspec

    from ..render.memory import needed_bytes

    facts = {
        "picture": job.sources.size,
        "frames": [job.first, job.last],
        "size": job.size,
        "fps": job.recipe.fps,
        "loop": job.recipe.loop,
        "layers": [{"name": layer.name, "what": _what(layer)} for layer in job.recipe.layers],
        "folder": str(job.folder),
        "spans": spans,
        "cache": {"folder": str(job.cache.folder), "cut": job.stack is not None, "bytes": job.cache.size()},
        "memory": round(needed_bytes(job)),
    }
    print(msgspec.json.encode(facts).decode())


def _range(first: int, last: int) -> str:
    return str(first) if first == last else f"{first} to {last}"


def _what(layer) -> str:
    words = [layer.motion.__struct_config__.tag]
    if layer.follows is not None:
        words.append(f"follows {layer.follows.layer}{' in the mirror' if layer.follows.mirror else ''}")
    if not layer.visible:
        words.append("hidden")
    return ", ".join(words)


def _megabytes(count: int) -> str:
    return f"{count / 1e6:.0f} MB"
