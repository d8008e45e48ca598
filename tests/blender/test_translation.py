"""What an artist reads is in the language of Blender's interface; sentences with names or numbers in them, too."""

import ast
import re
import sys
from pathlib import Path

import bpy
import pytest
import recipes
from panels import draw, registered
from pictures import paint
from pixels import PACKAGE

ADDON = Path(__file__).resolve().parents[2] / "addon"
# Which argument holds the sentence. A layout translates what is literal by itself: only texts that are put together
# must be translated before.
SAYING = {"report": 1, "poll_message_set": 0, "say": 2, "ValueError": 0, "OSError": 0}
SHOWING = ("label", "progress", "operator", "prop", "menu")
# What is without Blender, and what a recipe's author wrote: translated where it is caught, or the engine's own words.
OF_FILES = {"recipe/read.py", "build_zip.py", "overlay/water.py", "strokes/control_points.py"}


def modules() -> list[Path]:
    return [path for path in sorted(ADDON.rglob("*.py")) if path.relative_to(ADDON).as_posix() not in OF_FILES]


def sentences(tree):
    """The nodes that stand where an artist will read them, and whether literals are translated there."""
    for call in [node for node in ast.walk(tree) if isinstance(node, ast.Call)]:
        name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        if name in SAYING and len(call.args) > SAYING[name]:
            yield call.args[SAYING[name]], False
        if name in SHOWING:
            yield from ((keyword.value, True) for keyword in call.keywords if keyword.arg == "text")


def is_bare(node, literals_are_fine: bool) -> bool:
    """Whether it is a sentence of ours that nobody translates: two words in a row."""
    if isinstance(node, ast.IfExp):
        return is_bare(node.body, literals_are_fine) or is_bare(node.orelse, literals_are_fine)
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return not literals_are_fine and " " in node.value.strip()
    parts = [part.value for part in getattr(node, "values", []) if isinstance(part, ast.Constant)]
    return isinstance(node, ast.JoinedStr) and any(re.search(r"[a-z]{2}", part) for part in parts)


@pytest.mark.parametrize("path", modules(), ids=lambda path: path.relative_to(ADDON).as_posix())
def test_no_sentence_goes_untranslated(path):
    bare = [node for node, literal in sentences(ast.parse(path.read_text())) if is_bare(node, literal)]
    assert [(node.lineno, ast.unparse(node)) for node in bare] == []


@pytest.mark.parametrize("code, found", [
    ('self.report({"INFO"}, "Two words")', 1), ('self.report({"INFO"}, rpt_("Two words"))', 0),
    ('self.report({"INFO"}, f"{n} frames")', 1), ('layout.label(text="Two words")', 0),
    ('layout.label(text=f"{n} frames")', 1), ('layout.label(text=f"{a}, {b}")', 0),
    ('sidebar.say(context, layout, "a b" if x else y, "INFO")', 1), ('raise ValueError(path)', 0),
])  # fmt: skip
def test_what_counts_as_a_sentence(code, found):
    assert sum(is_bare(*sentence) for sentence in sentences(ast.parse(code))) == found


@pytest.fixture
def translated(monkeypatch):
    """Every sentence that our modules ask to be translated begins with ~.

    Blender as a Python module comes without languages and translates nothing, so its functions are stood in for.
    """
    for name, module in list(sys.modules.items()):
        if name.startswith(PACKAGE):
            for function in ("iface_", "rpt_", "tip_"):
                if hasattr(module, function):
                    assert getattr(module, function) is getattr(bpy.app.translations, f"pgettext_{function[:-1]}")
                    monkeypatch.setattr(module, function, lambda text: "~" + text)


def texts() -> str:
    panels = [*registered("view_3d"), *registered("node_editor")]
    return " ".join(text for panel in panels if panel.poll(bpy.context) for text in draw(panel).texts)


def test_the_panels_speak_the_language_of_the_interface(extension, scene, translated, tmp_path):
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "lake.png")))
    picture = scene.stillwater.active()
    picture.layers[0].motion.type = "bob"
    extension.properties.arrange.add_layer(picture, "sky").selected = True
    picture.layers[0].selected = True
    picture.missing = True
    scene.stillwater_live.view = "picture"
    extension.bake.outdated.look(scene, picture)
    shown = texts()
    for sentence in ("2 layers are selected", "Add a layer with Ripple: the water it floats on",
                     "Draw on it with Foreground, or choose its matte: which part of the picture it is", "Not baked yet"):
        assert f"~{sentence}" in shown, sentence
    picture.layers.clear()
    assert "~Add a layer for each part of the picture that moves" in texts()


def test_reports_poll_messages_and_units_do_too(extension, scene, translated, tmp_path):
    with pytest.raises(RuntimeError, match="~The scene has no Stillwater picture yet"):
        bpy.ops.stillwater.bake()
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "lake.png")))
    picture = scene.stillwater.active()
    with pytest.raises(RuntimeError, match="~Background: only a layer with the motion ~Sway has a ~Sway Line"):
        bpy.ops.stillwater.draw_stroke(role="sway_line")
    assert extension.ui.sidebar.label(picture.wind.bl_rna.properties["speed"]) == "~Speed (m/s)"
    bpy.ops.stillwater.draw_stroke(role="horizon")
    hint = extension.strokes.draw_mode.hint(scene)
    assert hint.startswith("~~Horizon of lake: ~Draw along the horizon")


def test_a_recipe_that_can_t_be_opened_is_told_in_it_too(scene, translated, tmp_path):
    path = recipes.write(tmp_path / "lake", {**recipes.whole(), "seed": 2**40})
    with pytest.raises(RuntimeError, match="~seed: 1099511627776 is above what Blender can hold"):
        bpy.ops.stillwater.load_recipe(filepath=str(path))


def test_what_knows_nothing_of_blender_is_told_how(extension, translated):
    progress, report = extension.bake.job.Progress(said=lambda text: "~" + text), extension.bake.report
    assert progress.message == "~Starting"
    progress.take({"event": "frame", "frame": 3, "of": 4, "seconds": 2})
    assert progress.message == "~Frame 1 of 4" and progress.left() == "~6 s left"
    progress.end(0, "")
    assert progress.message == "~Baked 1 frame"
    found = report.Report(ready=1, missing=((2, 3),), why=(), said=lambda text: "~" + text)
    assert found.lines == ["~Missing, the nearest is shown: ~frames 2-3"] and found.words == "~frames missing"
