"""Renders at a percentage of their size show the whole frame, made as small, instead of its middle.

Blender renders smaller, but an Image node gives its picture at full size, and the render's edges would cut it off. So
each output goes through a Scale node, whose factor a driver takes from the scene that is rendered. The driver is a plain
one of Blender's: it works without the extension, names no scene, and asks for no permission to run scripts.
"""

NAME = "Render Percentage"


def link(tree, source, target) -> None:
    """Links the output of one of a tree's sources with one of the tree's outputs; flow stays in pixels of the render."""
    factor, scale = _factor(tree), _node(tree, "CompositorNodeScale", f"Scale {target.name}")
    tree.links.new(source, scale.inputs["Image"])
    for axis in "XY":
        tree.links.new(factor, scale.inputs[axis])
    scaled = scale.outputs["Image"]
    if target.type == "VECTOR":
        shorter = _node(tree, "ShaderNodeVectorMath", f"Shorten {target.name}")
        shorter.operation = "SCALE"
        tree.links.new(scaled, shorter.inputs[0])
        tree.links.new(factor, shorter.inputs["Scale"])
        scaled = shorter.outputs[0]
    elif target.type == "VALUE":  # a Scale node gives colors, and their gray is not to the last bit what went in
        separate = _node(tree, "CompositorNodeSeparateColor", f"Separate {target.name}")
        tree.links.new(scaled, separate.inputs[0])
        scaled = separate.outputs[0]
    tree.links.new(scaled, target)


def _factor(tree):
    """The output that holds the render's share of its size."""
    if NAME not in tree.nodes:
        factor = _node(tree, "ShaderNodeValue", NAME).outputs[0]
        factor.default_value = 1
        driver = factor.driver_add("default_value").driver
        driver.expression = "percentage / 100"
        percentage = driver.variables.new()
        percentage.name, percentage.type = "percentage", "CONTEXT_PROP"
        percentage.targets[0].context_property = "ACTIVE_SCENE"
        percentage.targets[0].data_path = "render.resolution_percentage"
    return tree.nodes[NAME].outputs[0]


def _node(tree, kind: str, name: str):
    """The node of this name, made where there is none."""
    node = tree.nodes.get(name)
    if node is None:
        node = tree.nodes.new(kind)
        node.name, node.label, node.hide = name, name, True
        node.location = 180, -40 * len(tree.nodes)
    return node
