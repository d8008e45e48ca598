"""The Stillwater node: a plain group of built-in nodes, fed by the frames on disk.

    Image node (EXR sequence) -> as small as renders are (percentage.py) -> group output: Image, Alpha, Flow, Matte
    one more for each layer that the frames hold alone -> an output of its name

Until there are frames, a second Image node gives the picture at rest.

One tree for each picture, shared by all its nodes. Nothing here is a class of ours, so a file renders the same where
the extension is disabled.
"""

import json
from pathlib import Path

import bpy

from .. import versions
from ..properties import names
from . import frames, percentage

LAYER = "Stillwater"  # of the EXR files: the whole frame
SOURCE = "Frames"  # name of the Image node that reads it; those of single layers are "Frames NAME"
# Output of the Image node, output of the group, its kind.
OUTPUTS = [
    ("Combined", "Image", "NodeSocketColor"),
    ("Alpha", "Alpha", "NodeSocketFloat"),
    ("Flow", "Flow", "NodeSocketVector"),
    ("Matte", "Matte", "NodeSocketFloat"),
]
AT_REST = [("Image", "Image"), ("Alpha", "Alpha")]
ROOM = 650  # between the node and the output: for an artist's own nodes; seen whole, it all lies above Blender's shelf


def ensure(scene, picture):
    """The tree of `picture`, made where there is none. The picture keeps it alive where no compositor shows it."""
    if picture.tree is None:
        tree = bpy.data.node_groups.new(f"Stillwater {picture.name}", "CompositorNodeTree")
        tree.stillwater.picture = picture.id
        tree.stillwater.scene = scene.name
        for _, name, kind in OUTPUTS:
            tree.interface.new_socket(name, in_out="OUTPUT", socket_type=kind)
        source, output = tree.nodes.new("CompositorNodeImage"), tree.nodes.new("NodeGroupOutput")
        source.name, source.label = SOURCE, SOURCE
        output.location.x = source.location.x + 600
        picture.tree = tree
    _rest(picture.tree, picture.image)
    return picture.tree


def _rest(tree, image) -> None:
    """The node that gives the picture at rest shows `image`; without one it is not there."""
    source = tree.nodes.get("Picture")
    if source is None and image is not None:
        source = tree.nodes.new("CompositorNodeImage")
        source.name, source.label = "Picture", "Picture"
        source.location.y = tree.nodes[SOURCE].location.y - 350
    if source is not None and source.image != image:
        source.image = image


def describe(tree, scene, picture, folder: str, layers: list[tuple[str, str]]) -> None:
    """Writes on the tree what frames it is to show. `layers`: name of each layer of its own, and its EXR layer's."""
    state = tree.stillwater
    state.folder, state.name, state.loop = folder, picture.output.name, picture.loop
    state.first, state.last = scene.frame_start, scene.frame_end
    state.layers = json.dumps(layers)


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
    own = versions.own_compositor_tree(scene)
    if own is not None:
        _own_groups(own, picture.id)
    nodes = nodes_of(scene, picture.id)
    picture.id, picture.tree = names.new_id(), None
    names.rename_picture(picture)
    for node in nodes:
        node.node_tree = ensure(scene, picture)
        node.label = node.node_tree.name
    return ensure(scene, picture)


def _own_groups(tree, picture_id: str) -> None:
    """Makes the groups in `tree` that hold the picture's node, at any depth, this scene's alone."""
    for node in _groups(tree):
        inside = node.node_tree
        if inside.stillwater.picture != picture_id and any(_nodes_in(inside, picture_id)):
            node.node_tree = inside.copy()
            _own_groups(node.node_tree, picture_id)


def show(tree) -> list[int]:
    """Points the tree at what lies in its folder now; returns the frames found.

    A frame missing between `first` and `last` shows the nearest that is there. Without any the node gives the picture
    at rest.
    """
    state = tree.stillwater
    folder = Path(bpy.path.abspath(state.folder))
    there = frames.present(folder, state.name) if state.folder else []
    found = [frame for frame in there if state.first <= frame <= state.last]
    state.there = frames.spans(found)
    wanted = _layers_of(tree)
    _make_sockets(tree, [name for name, _ in wanted])
    sources = _make_sources(tree, [name for name, _ in wanted])
    _unlink(tree)
    if not found:
        for source in sources:
            source.image = None
        _show_at_rest(tree)
        return found
    image = _sequence(sources[0].image, frames.path_of(folder, state.name, found[0]), f"Stillwater {state.picture}")
    last = state.last if state.loop or not state.holds else found[-1]  # beyond it Blender itself holds the last one
    offsets = frames.offsets(state.first, last, found if state.holds else range(state.first, last + 1))
    for source, (socket, layer) in zip(sources, [("", LAYER), *wanted], strict=True):
        source.image = image
        source.frame_start, source.frame_duration = state.first, last - state.first + 1
        source.use_auto_refresh, source.use_cyclic = True, state.loop
        _hold(tree, source, offsets)
        _link(tree, source, layer, [(socket, "Combined")] if socket else [(name, part) for part, name, _ in OUTPUTS])
    return found


def _show_at_rest(tree) -> None:
    still = tree.nodes.get("Picture")
    if still is not None and still.image is not None:
        output = _output(tree)
        for part, socket in AT_REST:
            percentage.link(tree, still.outputs[part], output.inputs[socket])


def _output(tree):
    """The node at which the group's outputs are."""
    return next(node for node in tree.nodes if node.bl_idname == "NodeGroupOutput")


def _unlink(tree) -> None:
    """Takes all of the group's sources off its outputs."""
    for link in list(tree.links):
        tree.links.remove(link)


def let_go(tree) -> None:
    """Before a step is undone: takes images and keys off the tree, which show() brings back.

    They may have come with a timer, after the last undo step. Blender frees what the step does not hold, but keeps a
    tree that is the same in both steps as it is: it would be left pointing at them.
    """
    for source in tree.nodes:
        if source.name == SOURCE or source.name.startswith(f"{SOURCE} "):
            source.image = None
    action = tree.animation_data.action if tree.animation_data is not None else None
    if action is not None:
        tree.animation_data.action = None
        if action.users == 0:
            bpy.data.actions.remove(action)


def changed_on_disk(tree) -> bool:
    """Whether the frames in its folder are others than those that it shows."""
    state = tree.stillwater
    if not state.folder:
        return False
    if state.there and tree.nodes[SOURCE].image is None:
        return True
    there = frames.present(Path(bpy.path.abspath(state.folder)), state.name)
    return state.there != frames.spans([frame for frame in there if state.first <= frame <= state.last])


def _layers_of(tree) -> list[tuple[str, str]]:
    """Output and EXR layer of each layer that the frames hold alone; no two outputs have one name."""
    taken, found = [name for _, name, _ in OUTPUTS], []
    for name, layer in json.loads(tree.stillwater.layers or "[]"):
        socket, count = name, 0
        while socket in taken:
            count += 1
            socket = f"{name}.{count:03d}"
        taken.append(socket)
        found.append((socket, layer))
    return found


def _make_sockets(tree, layers: list[str]) -> None:
    """The group's outputs: those of every picture, and one of each layer; links of those that stay are kept."""
    wanted = [name for _, name, _ in OUTPUTS] + layers
    for item in [item for item in tree.interface.items_tree if item.item_type == "SOCKET"]:
        if item.name not in wanted:
            tree.interface.remove(item)
    there = [item.name for item in tree.interface.items_tree if item.item_type == "SOCKET"]
    for name in layers:
        if name not in there:
            tree.interface.new_socket(name, in_out="OUTPUT", socket_type="NodeSocketColor")


def _make_sources(tree, layers: list[str]) -> list:
    """The Image nodes: the whole frame's, and one for each layer."""
    whole = tree.nodes[SOURCE]
    wanted = [f"{SOURCE} {name}" for name in layers]
    for node in [node for node in tree.nodes if node.name.startswith(f"{SOURCE} ") and node.name not in wanted]:
        _release(tree, node)
        tree.nodes.remove(node)
    for place, name in enumerate(wanted, start=1):
        if name not in tree.nodes:
            node = tree.nodes.new("CompositorNodeImage")
            node.name, node.label = name, name
            node.location = (whole.location.x, whole.location.y - 320 * place)
    return [whole, *(tree.nodes[name] for name in wanted)]


def _sequence(image, path: Path, name: str):
    """The image of the sequence that `path` is a file of, as it is on disk now."""
    if image is None:
        image = bpy.data.images.load(str(path))
        image.name, image.source = name, "SEQUENCE"
    image.filepath = bpy.path.relpath(str(path)) if _can_be_relative(path) else str(path)
    # Both: either alone leaves a stale picture in renders or in the backdrop.
    image.reload()
    image.update_tag()
    return image


def _can_be_relative(path: Path) -> bool:
    """In a saved file, and on its drive."""
    return bool(bpy.data.filepath) and path.drive == Path(bpy.data.filepath).drive


def _link(tree, source, layer: str, pairs: list[tuple[str, str]]) -> None:
    """Makes the group give passes of `layer`; of frames that do not hold it, nothing."""
    output = _output(tree)
    try:
        source.layer = layer
    except TypeError:  # baked before layers were asked for
        source.image = None
        return
    for socket, part in pairs:
        percentage.link(tree, source.outputs[part], output.inputs[socket])


def _release(tree, source) -> None:
    """Takes the keys off the node's frame_offset."""
    path = f"{source.path_from_id()}.frame_offset"
    if tree.animation_data is not None:
        for curves in versions.channelbags(tree.animation_data):
            for curve in [curve for curve in curves if curve.data_path == path]:
                curves.remove(curve)


def _hold(tree, source, changes: list[tuple[int, int]]) -> None:
    """Sets the Image node's frame_offset, keyed where it changes, and again in each turn of a loop."""
    _release(tree, source)
    source.frame_offset = changes[0][1]
    if len(changes) == 1:
        return
    state, path = tree.stillwater, f"{source.path_from_id()}.frame_offset"
    again = [(state.last + 1, changes[0][1])] if state.loop else []
    versions.set_curve(tree, path, 0, [*changes, *again], "CONSTANT")
    if state.loop:
        curves = [curve for bag in versions.channelbags(tree.animation_data) for curve in bag]
        next(curve for curve in curves if curve.data_path == path).modifiers.new("CYCLES")


def add_node(scene, tree):
    """A node that shows `tree`, in the compositor of `scene`."""
    top = versions.compositor_tree(scene, create=True)
    node = top.nodes.new("CompositorNodeGroup")
    node.node_tree = tree
    node.label = tree.name
    node.width = 200
    return node


def nodes_of(scene, picture_id: str) -> list:
    """The nodes of the scene's compositor that show this picture, in groups too."""
    top = versions.compositor_tree(scene)
    return list(_nodes_in(top, picture_id)) if top else []


def _nodes_in(tree, picture_id: str):
    for node in _groups(tree):
        if node.node_tree.stillwater.picture == picture_id:
            yield node
        else:
            yield from _nodes_in(node.node_tree, picture_id)


def _groups(tree) -> list:
    return [node for node in tree.nodes if node.bl_idname == "CompositorNodeGroup" and node.node_tree]


def label(tree, words: str) -> None:
    """Lets every node that shows `tree` say how its frames are; a label that the artist gave stays."""
    text = f"{tree.name} ({words})" if words else tree.name
    trees = [*bpy.data.node_groups, *map(versions.compositor_tree, bpy.data.scenes)]
    for other in {tree for tree in trees if tree is not None and tree.bl_idname == "CompositorNodeTree"}:
        for node in _groups(other):
            ours = node.label == tree.name or node.label.startswith(f"{tree.name} (")
            if node.node_tree == tree and ours and node.label != text and other.library is None:
                node.label = text


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
    top = versions.compositor_tree(scene, create=True)
    shown = [node for node in nodes_of(scene, tree.stillwater.picture) if node.id_data == top]
    node = next(iter(shown), None) or add_node(scene, tree)
    output = versions.output_socket(top)
    node.location = (output.node.location.x - ROOM, output.node.location.y)
    top.links.new(node.outputs["Image"], output)
    for viewer in _viewers_of_ours(top) or ([top.nodes.new("CompositorNodeViewer")] if untouched else []):
        viewer.location = (output.node.location.x, output.node.location.y - 100)
        top.links.new(node.outputs["Image"], viewer.inputs["Image"])
    versions.use_compositor(scene)


def _viewers_of_ours(top) -> list:
    """The nodes that show a picture of ours as the backdrop."""
    viewers = [node for node in top.nodes if node.bl_idname == "CompositorNodeViewer" and node.inputs["Image"].links]
    return [viewer for viewer in viewers if _is_ours(viewer.inputs["Image"].links[0].from_node)]


def _is_ours(node) -> bool:
    tree = node.node_tree if node.bl_idname == "CompositorNodeGroup" else None
    return tree is not None and bool(tree.stillwater.picture)
