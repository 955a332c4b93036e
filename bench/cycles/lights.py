"""The lights of a scene that are no surfaces, for render.py: punctual ones, a sun, a sky.

A point light of Cycles sends 1 / (4 pi) cd for each W of its strength, a sun 1 lx for each W/m2: over a
plane the patches of each kind of light have what Lambert computes, to 5 digits.
"""

import json
import math
import struct

import bpy
import mathutils
import numpy

SKY_LX = 10_000  # of --sky without --sky-illuminance: radiosity/patch/light_options.h


def read_gltf(path):
    with open(path, "rb") as file:
        start = file.read(20)
        if start[:4] != b"glTF":
            raise SystemExit(f"{path}: not a GLB; convert it first")
        return json.loads(file.read(struct.unpack("<5I", start)[3]))


def local_matrix(node):
    if "matrix" in node:
        return mathutils.Matrix(numpy.array(node["matrix"]).reshape(4, 4).T.tolist())
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    return mathutils.Matrix.LocRotScale(mathutils.Vector(node.get("translation", [0, 0, 0])),
                                        mathutils.Quaternion((w, x, y, z)),
                                        mathutils.Vector(node.get("scale", [1, 1, 1])))


def read_punctual(path):
    """(light, position, direction in which it shines) of KHR_lights_punctual in the default scene."""
    gltf = read_gltf(path)
    lights = gltf.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    found = []

    def visit(number, above):
        node = gltf["nodes"][number]
        matrix = above @ local_matrix(node)
        light = node.get("extensions", {}).get("KHR_lights_punctual")
        if light is not None:
            aim = -matrix.col[2].to_3d().normalized()
            found.append((lights[light["light"]], matrix.translation.copy(), aim))
        for child in node.get("children", []):
            visit(child, matrix)

    for root in gltf["scenes"][gltf.get("scene", 0)]["nodes"]:
        visit(root, mathutils.Matrix())
    return found


def add_light(kind, colour, strength, position, aim):
    data = bpy.data.lights.new("light", kind)
    data.energy = strength
    data.color = colour
    if kind == "SUN":
        data.angle = 0
    else:
        data.shadow_soft_size = 0
    data.cycles.max_bounces = 1024
    item = bpy.data.objects.new("light", data)
    item.rotation_mode = "QUATERNION"
    item.rotation_quaternion = aim.to_track_quat("-Z", "Y")
    item.location = position
    bpy.context.scene.collection.objects.link(item)
    return data


def calculate(tree, operation, a, b):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, (a, b)):
        if isinstance(value, (int, float)):
            socket.default_value = value
        else:
            tree.links.new(value, socket)
    return node.outputs[0]


def dot(tree, socket, axis):
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = "DOT_PRODUCT"
    tree.links.new(socket, node.inputs[0])
    node.inputs[1].default_value = axis
    return node.outputs["Value"]


def clamp(tree, value):
    return calculate(tree, "MAXIMUM", calculate(tree, "MINIMUM", value, 1.0), 0.0)


def narrow_to_cone(data, spot, aim):
    """glTF's falloff, which is not that of Cycles' spots: a point light dimmed by its direction."""
    inner = math.cos(spot.get("innerConeAngle", 0))
    outer = math.cos(spot.get("outerConeAngle", math.pi / 4))
    data.use_nodes = True
    tree = data.node_tree
    incoming = tree.nodes.new("ShaderNodeNewGeometry").outputs["Incoming"]
    part = calculate(tree, "DIVIDE", calculate(tree, "SUBTRACT", dot(tree, incoming, aim), outer),
                     max(inner - outer, 1e-7))
    emission = next(node for node in tree.nodes if node.type == "EMISSION")
    tree.links.new(calculate(tree, "POWER", clamp(tree, part), 2.0), emission.inputs["Strength"])


def add_punctual(path, origin):
    for light, position, aim in read_punctual(path):
        colour, strength = light.get("color", [1, 1, 1]), light.get("intensity", 1)
        if light["type"] == "directional":
            add_light("SUN", colour, strength, position, aim)
            continue
        data = add_light("POINT", colour, 4 * math.pi * strength, position - origin, aim)
        if light["type"] == "spot":
            narrow_to_cone(data, light.get("spot", {}), aim)


def add_sun(options):
    """--sun: degrees clockwise from -z, and above the horizon."""
    around, up = math.radians(options["sun_azimuth_deg"]), math.radians(options["sun_elevation_deg"])
    aim = -mathutils.Vector((math.cos(up) * math.sin(around), math.sin(up),
                             -math.cos(up) * math.cos(around)))
    add_light("SUN", [1, 1, 1], options["sun_illuminance_lx"], mathutils.Vector(), aim)


def add_sky(options, world):
    """--sky uniform and overcast: black under the horizon, y = 0."""
    kind = options["sky"]
    if kind not in ("uniform", "overcast"):
        raise SystemExit(f"--sky {kind}: only uniform and overcast can be path-traced")
    world.use_nodes = True
    world.cycles_visibility.camera = False
    tree = world.node_tree
    direction = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
    height = dot(tree, direction, (0, 1, 0))
    luminance = calculate(tree, "GREATER_THAN", height, 0.0)
    scale = (options["sky_illuminance_lx"] or SKY_LX) / math.pi
    if kind == "overcast":  # E = 7 / 9 pi of the luminance of the zenith
        rise = calculate(tree, "ADD", calculate(tree, "MULTIPLY", height, 2.0), 1.0)
        luminance, scale = calculate(tree, "MULTIPLY", luminance, rise), scale * 9 / 7 / 3
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    tree.links.new(calculate(tree, "MULTIPLY", luminance, scale), background.inputs["Strength"])


def add_lights(options, scene_path, origin, world):
    """What options["lights"] of run.json says, and the punctual lights of the GLB, if one is given."""
    lights = options["lights"]
    if lights["ies"] or options["metres_per_unit"] != 1:
        raise SystemExit("photometric files and --scene-unit cannot be path-traced")
    if scene_path:
        add_punctual(scene_path, mathutils.Vector(origin))
    if lights["sun_illuminance_lx"] > 0:
        add_sun(lights)
    if lights["sky"]:
        add_sky(lights, world)
