"""A picture leaves, and with it everything that was made for it. What the artist made, and files on disk, stay."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty

from .. import versions
from ..bake import job, keeping, places
from ..bake.operators import sentence_of
from ..properties import arrange, clip, names
from ..properties.picture import frame_size
from ..ui import polls
from . import place
from . import scene as settings
from .open_picture import leave_mode


def remove(scene, index: int) -> None:
    """Removes the picture, its plane, camera, strokes, collection, image, node, keys and drivers.

    What another scene's copy of the picture uses too is only taken out of this scene.
    """
    picture = scene.stillwater.pictures[index]
    made = _Made(scene, picture)
    if picture.tree is not None:
        job.end(picture.tree)
    size, camera_gone = frame_size(picture), scene.camera is None or scene.camera == picture.camera
    arrange.remove_picture(scene, index)
    made.remove()
    versions.drop_compositor(scene)
    left = scene.stillwater.active()
    if left is None:
        settings.go_back(scene, camera_gone, size)
    elif camera_gone and left.camera is not None:
        settings.show(scene, left)


class _Made:
    """What was made for a picture, noted while the picture is there."""

    def __init__(self, scene, picture):
        self.scene = scene
        others = [other for other in names.all_pictures() if other.as_pointer() != picture.as_pointer()]
        shared = {thing for other in others for thing in _things(other)}
        self.collection = picture.collection
        self.collection_is_ours = picture.collection not in shared
        self.objects = [item for item in (*place.parts(picture), *clip.planes_of(picture)) if item not in shared]
        self.tree = picture.tree
        self.tree_is_ours = picture.tree not in shared
        self.image = picture.image

    def remove(self) -> None:
        self._remove_nodes()
        self._remove_objects()
        self._remove_collection()
        if self.image is not None and self.image.users == 0:
            bpy.data.images.remove(self.image)

    def _remove_nodes(self) -> None:
        if self.tree is None:
            return
        own = versions.compositor_tree(self.scene)
        trees = [*bpy.data.node_groups, *filter(None, map(versions.compositor_tree, bpy.data.scenes))]
        for tree in trees if self.tree_is_ours else filter(None, [own]):
            for shown in [item for item in tree.nodes if getattr(item, "node_tree", None) == self.tree]:
                tree.nodes.remove(shown)
        if self.tree_is_ours:
            frames = self.tree.nodes["Frames"].image
            action = _actions(self.tree)
            bpy.data.node_groups.remove(self.tree)
            _purge(bpy.data.images, [frames])
            _purge(bpy.data.actions, action)

    def _remove_objects(self) -> None:
        for item in self.objects:
            for child in [child for child in item.children if child not in self.objects]:
                _let_go(child)
            data, actions = item.data, _actions(item)
            bpy.data.objects.remove(item)
            if isinstance(data, bpy.types.Camera):
                actions += _actions(data)
                _purge(bpy.data.cameras, [data])
            elif isinstance(data, bpy.types.Image):
                _purge(bpy.data.images, [data] if data.source == "MOVIE" else [])
            elif isinstance(data, bpy.types.ID):
                actions += _actions(data)
                materials = list(data.materials)
                _purge(versions.grease_pencils(), [data])
                _purge(bpy.data.materials, materials)
            _purge(bpy.data.actions, actions)

    def _remove_collection(self) -> None:
        """What the artist put in there goes where the collection was."""
        if self.collection is None:
            return
        parents = [tree for tree in [self.scene.collection, *self.scene.collection.children_recursive]
                   if self.collection.name in tree.children]  # fmt: skip
        for parent in parents:
            parent.children.unlink(self.collection)
            for kind in ("objects", "children") if self.collection_is_ours else ():
                for item in getattr(self.collection, kind):
                    if item.name not in getattr(parent, kind):
                        getattr(parent, kind).link(item)
        if self.collection_is_ours:
            bpy.data.collections.remove(self.collection)


def _things(picture) -> list:
    made = (*place.parts(picture), *clip.planes_of(picture), picture.collection, picture.tree)
    return [thing for thing in made if thing is not None]


def _let_go(child) -> None:
    """An object of the artist's that hangs on one of ours stays where it is."""
    where = child.matrix_world.copy()
    child.parent = None
    child.matrix_world = where


def _actions(datablock) -> list:
    data = datablock.animation_data
    return [data.action] if data is not None and data.action is not None else []


def _purge(collection, things: list) -> None:
    """Removes those that nothing uses any more."""
    for thing in dict.fromkeys(things):  # an object and its data may share an action
        if thing is not None and thing.users == 0:
            collection.remove(thing)


class STILLWATER_OT_remove_picture(bpy.types.Operator):
    """Remove the active picture with its plane, camera, strokes and node. Its frames on disk stay"""

    bl_idname = "stillwater.remove_picture"
    bl_label = "Remove Picture"
    bl_options = {"REGISTER", "UNDO"}

    delete_files: BoolProperty(
        name="Delete Files", options={"SKIP_SAVE", "HIDDEN"},
        description="Delete its recipe, frames and cache from disk too. Undo does not bring them back",
    )

    @classmethod
    def description(cls, context, properties):
        if properties.delete_files:
            return rpt_("Remove the active picture and delete its recipe, frames and cache from disk")
        return ""

    @classmethod
    def poll(cls, context):
        return polls.own_picture(cls, context)

    def invoke(self, context, event):
        if self.delete_files:
            return context.window_manager.invoke_confirm(
                self, event, title=rpt_("Remove Picture and Delete Its Files"),
                message=rpt_("Undo brings the picture back, but not its frames"), icon="WARNING",
            )
        return self.execute(context)

    def draw(self, context):
        """Nothing to adjust afterwards: files are not brought back by unticking a box."""

    def execute(self, context):
        here = context.scene.stillwater
        picture = here.active()
        name, files, problem = picture.name, places.files_of(picture), ""
        leave_mode(context)
        try:
            if self.delete_files:
                keeping.forget_prepared(context.scene, picture)
        except OSError as error:
            problem = sentence_of(error)
        remove(context.scene, here.active_picture)
        context.view_layer.update()
        if files and not self.delete_files:
            sentence = rpt_("{name} is removed; its frames stay in {folder}")
            self.report({"INFO"}, sentence.format(name=name, folder=files.folder))
        elif files:
            try:
                sentence = rpt_("{name} and {count} files are removed")
                self.report({"INFO"}, sentence.format(name=name, count=files.delete()))
            except OSError as error:
                problem = sentence_of(error)
        if problem:
            self.report({"WARNING"}, rpt_("{name} is removed, its files are not: {why}").format(name=name, why=problem))
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_remove_picture]
