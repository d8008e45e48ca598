"""What differs between Blender 4.5 and 5.2, in one place. Everything else of the extension is the same in both."""

import bpy


def compositor_tree(scene, create: bool = False):
    """The node tree that composites `scene`; None where there is none and none is to be made."""
    if hasattr(scene, "compositing_node_group"):  # 5.0 and later: a node group as any other
        if scene.compositing_node_group is None and create:
            scene.compositing_node_group = bpy.data.node_groups.new("Compositing", "CompositorNodeTree")
        return scene.compositing_node_group
    if scene.node_tree is None and create:
        scene.use_nodes = True
        scene.node_tree.nodes.clear()
    return scene.node_tree


def own_compositor_tree(scene):
    """Like compositor_tree, but shared with no other scene: 5.2 shares it when a scene is copied, 4.5 does not."""
    tree = compositor_tree(scene)
    others = [other for other in bpy.data.scenes if other != scene and compositor_tree(other) == tree]
    if tree is not None and others:
        scene.compositing_node_group = tree.copy()
    return compositor_tree(scene)


def use_compositor(scene) -> None:
    """Makes renders of `scene` go through its compositor."""
    scene.render.use_compositing = True
    if not hasattr(scene, "compositing_node_group"):
        scene.use_nodes = True


def drop_compositor(scene) -> None:
    """Takes the compositor away from `scene`, where nothing but unconnected outputs are left in it."""
    tree = compositor_tree(scene)
    outputs = ("CompositorNodeComposite", "NodeGroupOutput", "CompositorNodeViewer")
    if tree is None or any(node.bl_idname not in outputs for node in tree.nodes):
        return
    if not hasattr(scene, "compositing_node_group"):
        tree.nodes.clear()
        scene.use_nodes = False
        return
    scene.compositing_node_group = None
    if tree.users == 0:
        bpy.data.node_groups.remove(tree)


def composites(scene) -> bool:
    """Whether renders of `scene` go through its compositor."""
    switched_on = hasattr(scene, "compositing_node_group") or scene.use_nodes
    return scene.render.use_compositing and switched_on and compositor_tree(scene) is not None


def sequencer_of(context):
    """The sequence editor that strips go into, made where there is none: of the workspace's scene where it has one."""
    scene = getattr(context.workspace, "sequencer_scene", None) or context.scene
    return scene.sequence_editor_create()


def strip_frames(strip) -> range:
    """The frames that a strip of the sequencer covers."""
    if hasattr(strip, "left_handle"):  # 5.0 and later
        return range(strip.left_handle, strip.right_handle)
    return range(strip.frame_final_start, strip.frame_final_end)


def set_strip_length(strip, frames: int) -> None:
    """Makes a strip cover so many frames from its first on."""
    if hasattr(strip, "duration"):
        strip.duration = frames
    else:
        strip.frame_final_duration = frames


def output_socket(tree):
    """The input socket of `tree` that takes the composited picture, made where there is none."""
    if hasattr(bpy.types, "CompositorNodeComposite"):  # before 5.0
        node = next((node for node in tree.nodes if node.bl_idname == "CompositorNodeComposite"), None)
        return (node or tree.nodes.new("CompositorNodeComposite")).inputs["Image"]
    outputs = [item for item in tree.interface.items_tree if item.item_type == "SOCKET" and item.in_out == "OUTPUT"]
    if not outputs:
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
    node = next((node for node in tree.nodes if node.bl_idname == "NodeGroupOutput"), None)
    return (node or tree.nodes.new("NodeGroupOutput")).inputs[0]


def grease_pencils():
    """The file's grease-pencil data; before 5.0 that name meant annotations."""
    return bpy.data.grease_pencils_v3 if hasattr(bpy.data, "grease_pencils_v3") else bpy.data.grease_pencils


def channelbags(data) -> list:
    """The collections of F-curves that move a datablock, given its animation data: its action's and its strips'."""
    strips = [strip for track in data.nla_tracks for strip in track.strips]
    used = [(data.action, data.action_slot), *((strip.action, strip.action_slot) for strip in strips)]
    bags = [bag for action, slot in used if (bag := _channelbag(action, slot)) is not None]
    return list({bag.as_pointer(): bag.fcurves for bag in bags}.values())  # strips may share an action


def stripped_paths(data) -> set[str]:
    """The paths that strips of the NLA animate."""
    strips = [strip for track in data.nla_tracks if not track.mute for strip in track.strips if not strip.mute]
    return {curve.data_path for strip in strips for curve in curves_of(strip.action, strip.action_slot)}


def curves_of(action, slot) -> list:
    """The F-curves that `slot` of `action` holds."""
    bag = _channelbag(action, slot)
    return list(bag.fcurves) if bag is not None else []


def _channelbag(action, slot):
    """An action has one layer and one strip in both versions; either may be missing in an empty one."""
    strips = [strip for layer in action.layers for strip in layer.strips] if action and slot else []
    return strips[0].channelbag(slot) if strips else None


def ensure_curve(datablock, path: str, index: int):
    """The F-curve of a property of `datablock` in its own action, made where it is missing."""
    data = datablock.animation_data or datablock.animation_data_create()
    if data.action is None:
        data.action = bpy.data.actions.new(f"{datablock.name}Action")
    return data.action.fcurve_ensure_for_datablock(datablock, path, index=index)


def set_curve(datablock, path: str, index: int, points: list[tuple], interpolation: str = "LINEAR") -> None:
    """Replaces the F-curve of a property of `datablock`: `points` are (frame, value)."""
    curve = ensure_curve(datablock, path, index)
    curve.keyframe_points.clear()
    curve.keyframe_points.add(len(points))
    curve.keyframe_points.foreach_set("co", [float(number) for point in points for number in point])
    for key in curve.keyframe_points:
        key.interpolation = interpolation
    curve.update()


def scale_curve(datablock, path: str, index: int, factor: float) -> None:
    """Multiplies the keys of a property's F-curves by `factor`, their handles too."""
    data = datablock.animation_data
    for curves in channelbags(data) if data is not None else ():
        for curve in curves:
            if curve.data_path == path and curve.array_index == index:
                for key in curve.keyframe_points:
                    for point in (key.co, key.handle_left, key.handle_right):
                        point.y *= factor
                curve.update()
