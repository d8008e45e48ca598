"""The Stillwater node: a plain group of built-in nodes, fed by the frames on disk.

    Image node (EXR sequence) -> group output: Image, Alpha, Flow, Matte

Until there are frames, a second Image node gives the picture at rest.

One tree for each picture, shared by all its nodes. Nothing here is a class of ours, so a file renders the same where
the extension is disabled.
"""

from pathlib import Path

import bpy

from .. import versions
from ..properties import names
from . import frames

LAYER = "Stillwater"  # of the EXR files
# Output of the Image node, output of the group, its kind.
OUTPUTS = [
    ("Combined", "Image", "NodeSocketColor"),
    ("Alpha", "Alpha", "NodeSocketFloat"),
    ("Flow", "Flow", "NodeSocketVector"),
    ("Matte", "Matte", "NodeSocketFloat"),
]
AT_REST = [("Image", "Image"), ("Alpha", "Alpha")]


def ensure(scene, picture):
    """The tree of `picture`, made where there is none. The picture keeps it alive where no compositor shows it."""
    if picture.tree is None:
        tree = bpy.data.node_groups.new(f"Stillwater {picture.name}", "CompositorNodeTree")
        tree.stillwater.picture = picture.id
        tree.stillwater.scene = scene.name
        for _, name, kind in OUTPUTS:
            tree.interface.new_socket(name, in_out="OUTPUT", socket_type=kind)
        source, output = tree.nodes.new("CompositorNodeImage"), tree.nodes.new("NodeGroupOutput")
        source.name, source.label = "Frames", "Frames"
        output.location.x = source.location.x + 300
        picture.tree = tree
    _rest(picture.tree, picture.image)
    return picture.tree


def _rest(tree, image) -> None:
    """The node that gives the picture at rest shows `image`; without one it is not there."""
    source = tree.nodes.get("Picture")
    if source is None and image is not None:
        source = tree.nodes.new("CompositorNodeImage")
        source.name, source.label = "Picture", "Picture"
        source.location.y = tree.nodes["Frames"].location.y - 350
    if source is not None and source.image != image:
        source.image = image


def claim(scene, picture):
    """The tree that `scene` may bake into.

    A copied scene holds a picture with the same id as the original's. When the copy is baked, it gets an id, a name, a
    tree and nodes of its own, so that the original's frames are not written over.
    """
    holders = [other.name for other in bpy.data.scenes if any(p.id == picture.id for p in other.stillwater.pictures)]
    owner = picture.tree.stillwater.scene if picture.tree else scene.name
    if owner == scene.name or owner not in holders:
        ensure(scene, picture).stillwater.scene = scene.name
        return picture.tree
    versions.own_compositor_tree(scene)
    nodes = nodes_of(scene, picture.id)
    picture.id, picture.tree = names.new_id(), None
    names.make_unique(picture, names.all_pictures())
    for node in nodes:
        node.node_tree = ensure(scene, picture)
        node.label = node.node_tree.name
    return ensure(scene, picture)


def show(tree) -> list[int]:
    """Points the tree at what lies in its folder now; returns the frames found.

    A frame missing between `first` and `last` shows the nearest that is there. Without any the node gives the picture
    at rest.
    """
    state, source = tree.stillwater, tree.nodes["Frames"]
    folder = Path(bpy.path.abspath(state.folder))
    there = frames.present(folder, state.name) if state.folder else []
    found = [frame for frame in there if state.first <= frame <= state.last]
    if not found:
        source.image = None
        still = tree.nodes.get("Picture")
        _link(tree, still, AT_REST if still is not None and still.image is not None else [])
        return found
    _point(source, frames.path_of(folder, state.name, found[0]), f"Stillwater {state.picture}")
    source.frame_start = state.first
    source.frame_duration = state.last - state.first + 1
    source.use_auto_refresh = True
    source.use_cyclic = False
    _hold(tree, frames.offsets(state.first, state.last, found))
    _link(tree, source, [(name, shown) for name, shown, _ in OUTPUTS])
    return found


def _link(tree, source, pairs: list[tuple[str, str]]) -> None:
    """Makes the group give these outputs of `source`, and none of its other source's."""
    for link in [link for link in tree.links if link.from_node.name in ("Frames", "Picture")]:
        tree.links.remove(link)
    output = next(node for node in tree.nodes if node.bl_idname == "NodeGroupOutput")
    for name, shown in pairs:
        tree.links.new(source.outputs[name], output.inputs[shown])


def _point(source, path: Path, name: str) -> None:
    """Makes the Image node read the sequence that `path` is a file of, as it is on disk now."""
    if source.image is None:
        source.image = bpy.data.images.load(str(path))
        source.image.name, source.image.source = name, "SEQUENCE"
    image = source.image
    image.filepath = bpy.path.relpath(str(path)) if _can_be_relative(path) else str(path)
    source.layer = LAYER
    # Both: either alone leaves a stale picture in renders or in the backdrop.
    image.reload()
    image.update_tag()


def _can_be_relative(path: Path) -> bool:
    """In a saved file, and on its drive."""
    return bool(bpy.data.filepath) and path.drive == Path(bpy.data.filepath).drive


def _hold(tree, changes: list[tuple[int, int]]) -> None:
    """Sets the Image node's frame_offset, keyed where it changes."""
    source = tree.nodes["Frames"]
    path = f"{source.path_from_id()}.frame_offset"
    if tree.animation_data is not None:
        for curves in versions.channelbags(tree.animation_data):
            for curve in [curve for curve in curves if curve.data_path == path]:
                curves.remove(curve)
    source.frame_offset = changes[0][1]
    if len(changes) > 1:
        versions.set_curve(tree, path, 0, changes, "CONSTANT")


def add_node(scene, tree):
    """A node that shows `tree`, in the compositor of `scene`."""
    top = versions.compositor_tree(scene, create=True)
    node = top.nodes.new("CompositorNodeGroup")
    node.node_tree = tree
    node.label = tree.name
    node.width = 200
    return node


def nodes_of(scene, picture_id: str) -> list:
    """The nodes of the scene's compositor that show this picture."""
    top = versions.compositor_tree(scene)
    groups = [node for node in top.nodes if node.bl_idname == "CompositorNodeGroup" and node.node_tree] if top else []
    return [node for node in groups if node.node_tree.stillwater.picture == picture_id]


def is_free(scene) -> bool:
    """Whether nothing but the 3D render, or a node of ours, stands at the output of the scene's compositor."""
    top = versions.compositor_tree(scene)
    if top is None:
        return True
    sources = [link.from_node for link in versions.output_socket(top).links]
    return all(node.bl_idname == "CompositorNodeRLayers" or _is_ours(node) for node in sources)


def wire(scene, tree) -> None:
    """Makes the scene's render the tree's Image; its alpha is in it. A node that shows it already is used.

    A compositor that is new gets a Viewer too, for the backdrop; one that showed another picture shows this.
    """
    top = versions.compositor_tree(scene)
    untouched = top is None or not top.nodes
    node = next(iter(nodes_of(scene, tree.stillwater.picture)), None) or add_node(scene, tree)
    top = versions.compositor_tree(scene)
    output = versions.output_socket(top)
    node.location = (output.node.location.x - 300, output.node.location.y)
    top.links.new(node.outputs["Image"], output)
    for viewer in _viewers_of_ours(top) or ([top.nodes.new("CompositorNodeViewer")] if untouched else []):
        viewer.location = (output.node.location.x, output.node.location.y - 150)
        top.links.new(node.outputs["Image"], viewer.inputs["Image"])
    versions.use_compositor(scene)


def _viewers_of_ours(top) -> list:
    """The nodes that show a picture of ours as the backdrop."""
    viewers = [node for node in top.nodes if node.bl_idname == "CompositorNodeViewer" and node.inputs["Image"].links]
    return [viewer for viewer in viewers if _is_ours(viewer.inputs["Image"].links[0].from_node)]


def _is_ours(node) -> bool:
    tree = node.node_tree if node.bl_idname == "CompositorNodeGroup" else None
    return tree is not None and bool(tree.stillwater.picture)
