"""The extension comes and goes without a trace, and stays where its engine can't."""

import addon_utils
import bpy
import pytest
from pixels import PACKAGE

CLASSES = (
    bpy.types.PropertyGroup, bpy.types.Operator, bpy.types.Panel, bpy.types.UIList, bpy.types.Menu,
    bpy.types.FileHandler, bpy.types.AddonPreferences,
)  # fmt: skip


def traces():
    """What of ours Blender knows."""
    ours = [cls for kind in CLASSES for cls in kind.__subclasses__() if "STILLWATER" in cls.__name__]
    classes = {cls.__name__ for cls in ours if cls.is_registered}
    lists = [_list(getattr(bpy.app.handlers, name)) for name in dir(bpy.app.handlers)]
    handlers = [handler for listed in lists for handler in listed if PACKAGE in handler.__module__]
    kinds = [getattr(bpy.types, name) for name in dir(bpy.types)]
    added = [draw for kind in kinds for draw in getattr(getattr(kind, "draw", None), "_draw_funcs", [])]
    menus = [draw for draw in added if PACKAGE in draw.__module__] + bpy.utils.preset_paths("stillwater/sway")
    owners = (bpy.types.Scene, bpy.types.CompositorNodeTree)
    properties = [(kind, name) for kind in owners for name in dir(kind) if name.startswith("stillwater")]
    return classes, handlers, menus, properties


def _list(value):
    return value if isinstance(value, list) else []


@pytest.fixture
def enabled():
    """Leaves the extension enabled, whatever happens."""
    yield
    addon_utils.disable(PACKAGE)
    assert addon_utils.enable(PACKAGE) is not None


def test_it_is_registered_after_its_installation(extension):
    classes, handlers, menus, properties = traces()
    assert {"STILLWATER_OT_bake", "STILLWATER_PG_layer", "STILLWATER_UL_layers", "STILLWATER_PT_view_3d"} <= classes
    assert len(handlers) >= 15 and len(menus) >= 8 and len(properties) >= 4
    assert extension.engine.problem() == "" and extension.engine.version().count(".") == 2


def test_registering_twice_leaves_nothing_behind(extension, enabled):
    before = traces()
    for _ in range(2):
        addon_utils.disable(PACKAGE)
        assert [len(kind) for kind in traces()] == [0, 0, 0, 0]
        addon_utils.enable(PACKAGE)
        assert [len(kind) for kind in traces()] == [len(kind) for kind in before]


def test_an_error_while_registering_is_raised_and_leaves_nothing_behind(extension, enabled, monkeypatch):
    addon_utils.disable(PACKAGE)
    monkeypatch.setattr(extension.pictures, "register", lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        extension.register()
    assert [len(kind) for kind in traces()] == [0, 0, 0, 0]


@pytest.fixture
def without_engine(extension, enabled, monkeypatch):
    """The extension registered where `import stillwater` fails as on a machine whose libraries do not fit."""
    addon_utils.disable(PACKAGE)
    import sys

    for name in [name for name in sys.modules if name.split(".")[0] == "stillwater"]:
        monkeypatch.delitem(sys.modules, name)

    class Missing:
        def find_spec(self, name, path=None, target=None):
            if name == "stillwater._stillwater":
                raise ImportError("libopencv_core.so.406: cannot open shared object file")

    monkeypatch.setattr(sys, "meta_path", [Missing(), *sys.meta_path])
    extension.register()
    yield
    extension.unregister()


def test_without_its_engine_it_registers_and_says_why(extension, without_engine, scene):
    sentence = "The engine can't be loaded: libopencv_core.so.406: cannot open shared object file"
    assert extension.engine.problem() == sentence and extension.engine.version() == ""
    picture = extension.properties.arrange.add_picture(scene, "Lake")
    assert picture.name == "Lake"
    assert not bpy.ops.stillwater.bake.poll() and not bpy.ops.stillwater.load_recipe.poll()
    with pytest.raises(ValueError, match="libopencv_core"):
        extension.engine.worker_command()
    with pytest.raises(ValueError, match="libopencv_core"):
        extension.engine.read_recipe("x.json")


def test_without_its_engine_the_panel_says_why(extension, without_engine, scene):
    from panels import draw, registered

    said = " ".join(draw(registered("view_3d")[0]).texts)
    assert "The engine can't be loaded: libopencv_core.so.406: cannot open shared object file" in said
