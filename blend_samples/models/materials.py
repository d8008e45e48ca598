"""Materials: pigments with a broken tone, leaves that let light through, clouds."""

import bpy
import numpy as np


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


def veil(name: str) -> bpy.types.Material:
    """What hangs in the air and shows its own light: colour and coverage are the mesh's attribute "tone"."""
    material, tree, shader = _new(name)
    tree.nodes.remove(shader)
    material.cycles.emission_sampling = "NONE"
    tone = tree.nodes.new("ShaderNodeAttribute")
    tone.attribute_name = "tone"
    clear = tree.nodes.new("ShaderNodeBsdfTransparent")
    glow = tree.nodes.new("ShaderNodeEmission")
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(tone.outputs["Color"], glow.inputs["Color"])
    tree.links.new(tone.outputs["Alpha"], mix.inputs[0])
    tree.links.new(clear.outputs[0], mix.inputs[1])
    tree.links.new(glow.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs[0])
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


def toned(name: str, roughness: float = 0.7, through: float = 0.0) -> bpy.types.Material:
    """Paint, wood or cloth coloured by the mesh's attribute "tone"; cloth lets `through` of the light pass."""
    if through:
        return leaf(name, "tone", through)
    material, tree, shader = _new(name)
    tone = tree.nodes.new("ShaderNodeAttribute")
    tone.attribute_name = "tone"
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Specular IOR Level"].default_value = 0.25
    tree.links.new(tone.outputs["Color"], shader.inputs["Base Color"])
    return material


def water(name: str, deep: tuple, swell: float, chop: float, size: float = 1.6, stretch: float = 2.5,
          heading: float = 0.0) -> bpy.types.Material:
    """Water that mirrors; `swell` and `chop` tilt its surface by long and short waves (0..1), `size` of the long
    ones in metres, drawn out `stretch` times along `heading` (degrees from +X)."""
    material, tree, shader = _new(name)
    shader.inputs["Base Color"].default_value = (*deep, 1)
    shader.inputs["Roughness"].default_value = 0.06
    shader.inputs["IOR"].default_value = 1.34
    shader.inputs["Specular IOR Level"].default_value = 0.5
    where = tree.nodes.new("ShaderNodeTexCoord")
    bump = None
    for features, strength in ((1 / size, swell), (3.3 / size, chop)):
        mapping = tree.nodes.new("ShaderNodeMapping")
        mapping.inputs["Rotation"].default_value = (0, 0, -np.radians(heading))
        mapping.inputs["Scale"].default_value = (features / stretch, features, features)
        noise = tree.nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value = 1.0
        noise.inputs["Detail"].default_value = 2.5
        tree.links.new(where.outputs["Object"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs[0], noise.inputs["Vector"])
        step = tree.nodes.new("ShaderNodeBump")
        step.inputs["Strength"].default_value = 1.0
        step.inputs["Distance"].default_value = strength * 0.1 / features
        tree.links.new(noise.outputs["Fac"], step.inputs["Height"])
        if bump is not None:
            tree.links.new(bump.outputs[0], step.inputs["Normal"])
        bump = step
    tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    return material


def lamp(name: str, colour: tuple, strength: float) -> bpy.types.Material:
    """What shines by itself."""
    material, tree, shader = _new(name)
    shader.inputs["Base Color"].default_value = (0, 0, 0, 1)
    shader.inputs["Emission Color"].default_value = (*colour, 1)
    shader.inputs["Emission Strength"].default_value = strength
    return material
