# SPDX-License-Identifier: Apache-2.0
"""Builds the scene of this folder in Blender 3.4 or later, with its caustics.

    blender --python blender.py                                   opens it
    blender -b --python blender.py -o //picture_ -f 1             renders it without a window

Nephroid's `export` wrote this file. Light that comes through glass or from a mirror is in the pictures caustic-*.exr,
in W/m^2, and each receiver sends out what it reflects of it. So Cycles must not make caustics itself: these are
switched off, and glass keeps its shadow.
"""
import json
from math import log2, pi, radians
from pathlib import Path

import bpy
import numpy
from mathutils import Matrix, Vector

FOLDER = Path(__file__).resolve().parent
ABOUT = json.loads((FOLDER / "caustics.json").read_text())


def to_blender(v):
    """From y up to z up."""
    return Vector((v[0], -v[2], v[1]))


def import_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if "bool" not in vars(numpy):
        numpy.bool = bool  # the importer of Blender 3.4 asks for it, and Debian 12's numpy no longer has it
    bpy.ops.import_scene.gltf(filepath=str(FOLDER / "scene.glb"))
    for light in bpy.data.lights:
        if light.type == "SUN":
            light.angle = 0
        else:
            light.shadow_soft_size = 0


def picture(nodes, file):
    image = bpy.data.images.load(str(FOLDER / file))
    node = nodes.new("ShaderNodeTexImage")
    node.image = image
    node.extension = "EXTEND"
    return node


def make_matt(name, rgb, caustic):
    """Lambert's law, as in Nephroid. rgb: the reflectance."""
    material = bpy.data.materials.new(f"{name}, matt")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    surface = nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (*rgb, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    shader = surface.outputs[0]
    if caustic:
        seen = nodes.new("ShaderNodeVectorMath")
        seen.operation = "MULTIPLY"
        seen.inputs[1].default_value = rgb
        links.new(picture(nodes, caustic["file"]).outputs["Color"], seen.inputs[0])
        side = nodes.new("ShaderNodeMath")  # light falls on one side: 0 on the other
        side.operation = "MULTIPLY_ADD"
        factor, offset = (-1 / pi, 1 / pi) if caustic["front"] else (1 / pi, 0)
        side.inputs[1].default_value, side.inputs[2].default_value = factor, offset
        links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], side.inputs[0])
        light = nodes.new("ShaderNodeEmission")
        links.new(seen.outputs["Vector"], light.inputs["Color"])
        links.new(side.outputs[0], light.inputs["Strength"])
        both = nodes.new("ShaderNodeAddShader")
        links.new(shader, both.inputs[0])
        links.new(light.outputs[0], both.inputs[1])
        shader = both.outputs[0]
    links.new(shader, output.inputs["Surface"])
    return material


def make_materials():
    caustics = {c["object"]: c for c in ABOUT["caustics"]}
    for name, rgb in ABOUT["matt"].items():
        # as much of it as Blender keeps; of an object without triangles there is none
        mesh = bpy.data.meshes.get(name[:63])
        if mesh:
            mesh.materials.clear()
            mesh.materials.append(make_matt(name, rgb, caustics.get(name)))


def add_area_lights():
    for number, about in enumerate(ABOUT["area_lights"]):
        light = bpy.data.lights.new(f"area light {number}", "AREA")
        edges = [to_blender(edge) for edge in about["edges_m"]]
        light.shape, light.size, light.size_y = "RECTANGLE", edges[0].length, edges[1].length
        light.color, light.energy = about["colour"], about["luminous_w"] * 4 / pi  # Cycles sends out pi/4 of it
        item = bpy.data.objects.new(light.name, light)
        back = -to_blender(about["direction"]).normalized()  # a lamp shines along its -z
        x = edges[0].normalized()
        turn = Matrix((x, back.cross(x), back)).transposed().to_4x4()
        item.matrix_world = Matrix.Translation(to_blender(about["position_m"])) @ turn
        bpy.context.scene.collection.objects.link(item)


def add_surroundings():
    world = bpy.context.scene.world = bpy.data.worlds.new("surroundings")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    background = nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    about = ABOUT["surroundings"]
    if not about:
        return
    image = nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(str(FOLDER / about["file"]))
    turn = nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value[2] = -radians(90 + about["rotate_deg"])  # the picture's middle looks along y
    links.new(nodes.new("ShaderNodeTexCoord").outputs["Generated"], turn.inputs["Vector"])
    links.new(turn.outputs["Vector"], image.inputs["Vector"])
    links.new(image.outputs["Color"], background.inputs["Color"])
    background.inputs["Strength"].default_value = about["radiance"]
    if not about["lights"]:  # a backdrop
        world.cycles_visibility.diffuse = False


def set_up_rendering():
    scene = bpy.context.scene
    scene.camera = next(item for item in scene.objects if item.type == "CAMERA")
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = ABOUT["resolution"]
    scene.cycles.samples = 128
    scene.cycles.use_denoising = False
    scene.cycles.sample_clamp_indirect = 0  # it would darken what glass shows where white is above 10
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = False
    scene.cycles.max_bounces = scene.cycles.transmission_bounces = scene.cycles.glossy_bounces = 32
    scene.cycles.diffuse_bounces = 32 if ABOUT["indirect"] else 0
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.exposure = -log2(ABOUT["white"])


import_scene()
make_materials()
add_area_lights()
add_surroundings()
set_up_rendering()
