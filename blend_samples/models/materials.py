"""Materials: pigments with a broken tone, leaves that let light through, clouds."""

import bpy


def pigment(name: str, dark: tuple, light: tuple, scale: float = 1.0, roughness: float = 0.9,
            attribute: str | None = None) -> bpy.types.Material:
    """A matt paint between two linear colours, mixed by noise of `scale` features a metre.

    attribute: a colour attribute of the mesh that is multiplied in.
    """
    material, tree, shader = _new(name)
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Specular IOR Level"].default_value = 0.15
    colour = _mottle(tree, dark, light, scale)
    if attribute:
        colour = _times(tree, colour, attribute)
    tree.links.new(colour, shader.inputs["Base Color"])
    return material


def leaf(name: str, attribute: str = "tone", through: float = 0.35) -> bpy.types.Material:
    """Leaves coloured by the mesh's attribute; `through` of the light shines through them."""
    material, tree, shader = _new(name)
    tree.nodes.remove(shader)
    tone = tree.nodes.new("ShaderNodeAttribute")
    tone.attribute_name = attribute
    back = tree.nodes.new("ShaderNodeBsdfDiffuse")
    glow = tree.nodes.new("ShaderNodeBsdfTranslucent")
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = through
    out = tree.nodes["Material Output"]
    tree.links.new(tone.outputs["Color"], back.inputs["Color"])
    tree.links.new(tone.outputs["Color"], glow.inputs["Color"])
    tree.links.new(back.outputs[0], mix.inputs[1])
    tree.links.new(glow.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], out.inputs[0])
    return material


def cloud(name: str, light: tuple, shadow: tuple, shadow_strength: float = 0.35) -> bpy.types.Material:
    """A body that is lit softly and glows a little by itself, as what scatters inside a cloud does."""
    material, tree, shader = _new(name)
    shader.inputs["Base Color"].default_value = (*light, 1)
    shader.inputs["Roughness"].default_value = 1
    shader.inputs["Specular IOR Level"].default_value = 0
    shader.inputs["Emission Color"].default_value = (*shadow, 1)
    shader.inputs["Emission Strength"].default_value = shadow_strength
    return material


def _new(name: str):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    return material, material.node_tree, material.node_tree.nodes["Principled BSDF"]


def _mottle(tree, dark, light, scale):
    where = tree.nodes.new("ShaderNodeTexCoord")
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = scale
    noise.inputs["Detail"].default_value = 6
    noise.inputs["Roughness"].default_value = 0.65
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[1].position = 0.36, 0.64
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (*dark, 1), (*light, 1)
    tree.links.new(where.outputs["Object"], noise.inputs["Vector"])
    tree.links.new(noise.outputs["Fac"], ramp.inputs["Fac"])
    return ramp.outputs["Color"]


def _times(tree, colour, attribute):
    tone = tree.nodes.new("ShaderNodeAttribute")
    tone.attribute_name = attribute
    mix = tree.nodes.new("ShaderNodeMix")
    mix.data_type, mix.blend_type = "RGBA", "MULTIPLY"
    mix.inputs["Factor"].default_value = 1
    tree.links.new(colour, mix.inputs["A"])
    tree.links.new(tone.outputs["Color"], mix.inputs["B"])
    return mix.outputs["Result"]
