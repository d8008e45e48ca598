"""Speaks the worker's protocol without an engine: `fake_worker.py MODE FRAMES render RECIPE --progress json --parent`.

Copies prepared frames into the recipe's output folder. MODE says what goes wrong on the way.
"""

import json
import os
import shutil
import signal
import sys
import time
from pathlib import Path

mode, source, verb, recipe_file, *options = sys.argv[1:]
assert verb == "render" and options[:3] == ["--progress", "json", "--parent"], sys.argv


def say(**event):
    print(json.dumps(event), flush=True)


recipe = json.loads(Path(recipe_file).read_text())
first, last = recipe["frames"]
if "--frames" in options:
    first, last = map(int, options[options.index("--frames") + 1].split("-"))
folder = Path(recipe_file).parent / recipe["output"]["folder"]
(folder.parent / "options.txt").write_text(" ".join(options))
if mode == "refuse":
    say(event="error", sentence="layers[0].motion.frequency: 0 is not above 0 (Hz)")
    sys.exit(2)
say(event="started", first=first, last=last, of=last - first + 1, size=[16, 8], folder=str(folder))
say(event="preparing", share=0.4, what="fill of all")
say(event="warning", sentence="picture: 3 pixels are not numbers (read as 0)")
folder.mkdir(parents=True, exist_ok=True)
for frame in range(first, last + 1):
    if frame == last and mode == "crash":
        print("Segfault ahead", file=sys.stderr, flush=True)
        os.kill(os.getpid(), signal.SIGSEGV)
    if frame == last and mode == "give up":
        say(event="error", sentence=f"{folder}: no space left")
        sys.exit(1)
    if frame == last and mode == "leave":
        sys.exit(3)
    if mode == "garbage":
        print('not JSON {"event": \n[1, 2]\n"text"\n{"event": 7}\n{"event": "new"}\n{"event": "frame"}', flush=True)
        sys.stdout.buffer.write(b"\xff\xfe\n")
    name = f"{recipe['output']['name']}_{frame:04d}.exr"
    shutil.copy(Path(source) / name, folder / name)
    say(event="frame", frame=frame, of=last - first + 1, seconds=0.01, path=str(folder / name))
    if mode == "slow":
        time.sleep(0.05)
    if mode in ("hang", "deaf") and frame == last - 1:
        if mode == "deaf":
            signal.signal(signal.SIGTERM, signal.SIG_IGN)
        say(event="preparing", share=0.9, what="nothing at all")
        sys.stdin.read()  # as with --parent: until whoever started it has gone
        time.sleep(0 if mode == "hang" else 60)
        sys.exit(0)
say(event="done", rendered=last - first + 1, kept=0, seconds=0.04)
