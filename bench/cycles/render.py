"""Path-traces what Lambert solved, with Cycles: the same triangles, reflectances and view.

    blender --background --factory-startup --python render.py -- \
        BAKED_DIR OUT_DIR [SAMPLES [SEEDS [SCENE.glb]]]

BAKED_DIR is an output folder of `lambert bake`. Each triangle of its patches.csv gets a diffuse BSDF
of its reflectance, and emits exitance / pi from its front; backs of one-sided triangles are black, and
cameras see through them. SCENE.glb, the file that was baked, is read for its punctual lights alone; sky and
sun are those of run.json. The camera is the node `view` of the GLB; the picture has half the pixels of
the PNG each way, and all samples of a rendering are taken at one point of their pixel, the next one's at another: at
first the middle. Writes OUT_DIR/seed_K.exr for each of SEEDS (16) renderings of SAMPLES (2) samples a pixel: luminance in cd/m2, and in the layer `patch` the number of the patch in
digits of base 256. Nothing is clamped, denoised or cut short under 1024 bounces, the most that Cycles takes.
The environment may set THREADS (1) and BOUNCES (1024).
"""

import csv
import json
import math
import os
import struct
import sys

import bpy
import mathutils
import numpy

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import lights  # noqa: E402


def read_patches(folder):
    """Corners [n, 3, 3] in metres, reflectance and exitance [n, 3], of patches.csv."""
    with open(os.path.join(folder, "patches.csv"), newline="") as file:
        rows = csv.reader(file)
        column = {name: at for at, name in enumerate(next(rows))}
        wanted = [f"{axis}{k}" for k in range(3) for axis in "xyz"]
        wanted += [f"{what}_{c}" for what in ("reflectance", "exitance") for c in "rgb"]
        at = [column[name] for name in wanted]
        values = numpy.array([[float(row[k]) for k in at] for row in rows])
    return values[:, :9].reshape(-1, 3, 3), values[:, 9:12], values[:, 12:15]


def read_run(folder):
    with open(os.path.join(folder, "run.json")) as file:
        return json.load(file)


def read_view(folder):
    """Matrix, camera and origin of the patches: what the GLB says."""
    gltf = lights.read_gltf(os.path.join(folder, read_run(folder)["name"] + ".glb"))
    view = next(node for node in gltf["nodes"] if "camera" in node)
    matrix = mathutils.Matrix(numpy.array(view["matrix"]).reshape(4, 4).T.tolist())
    return matrix, gltf["cameras"][view["camera"]], gltf["nodes"][0].get("translation", [0, 0, 0])


def find_backs(corners):
    """True for patches that are the other side of the one before."""
    def sorted_corners(triangles):
        order = numpy.lexsort((triangles[:, :, 2], triangles[:, :, 1], triangles[:, :, 0]))
        return numpy.take_along_axis(triangles, order[:, :, None], axis=1)

    def normals(triangles):
        return numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])

    same = numpy.zeros(len(corners), bool)
    ordered, normal = sorted_corners(corners), normals(corners)
    same[1:] = (ordered[1:] == ordered[:-1]).all(axis=(1, 2))
    same[1:] &= (normal[1:] * normal[:-1]).sum(axis=1) < 0
    for k in numpy.flatnonzero(same):  # of three in a row the third begins anew
        if same[k - 1]:
            same[k] = False
    return same


def make_material(emits):
    """Reads the attributes reflectance, emission, two_sided and digits of the faces."""
    material = bpy.data.materials.new("lamp" if emits else "surface")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()

    def attribute(name):
        node = nodes.new("ShaderNodeAttribute")
        node.attribute_name = name
        return node

    def calculate(operation, a, b):
        node = nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, (a, b)):
            if isinstance(value, (int, float)):
                socket.default_value = value
            else:
                links.new(value, socket)
        return node.outputs[0]

    back = nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"]
    two_sided = attribute("two_sided").outputs["Fac"]
    dead = calculate("MULTIPLY", back, calculate("SUBTRACT", 1, two_sided))
    alive = calculate("SUBTRACT", 1, dead)

    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    scale = nodes.new("ShaderNodeVectorMath")
    scale.operation = "SCALE"
    links.new(attribute("reflectance").outputs["Vector"], scale.inputs[0])
    links.new(alive, scale.inputs["Scale"])
    links.new(scale.outputs["Vector"], diffuse.inputs["Color"])
    surface = diffuse.outputs[0]
    if emits:
        emission = nodes.new("ShaderNodeEmission")
        links.new(attribute("emission").outputs["Vector"], emission.inputs["Color"])
        links.new(alive, emission.inputs["Strength"])
        both = nodes.new("ShaderNodeAddShader")
        links.new(surface, both.inputs[0])
        links.new(emission.outputs[0], both.inputs[1])
        surface = both.outputs[0]
    is_camera = nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"]
    see_through = nodes.new("ShaderNodeMixShader")
    links.new(calculate("MULTIPLY", dead, is_camera), see_through.inputs[0])
    links.new(surface, see_through.inputs[1])
    links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], see_through.inputs[2])
    links.new(see_through.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])

    # The number of the patch; behind a two-sided triangle that of its back, the next. Faces that are
    # seen through write nothing.
    digits = nodes.new("ShaderNodeVectorMath")
    digits.operation = "ADD"
    shift = nodes.new("ShaderNodeCombineXYZ")
    links.new(calculate("MULTIPLY", back, two_sided), shift.inputs[0])
    links.new(attribute("digits").outputs["Vector"], digits.inputs[0])
    links.new(shift.outputs[0], digits.inputs[1])
    number = nodes.new("ShaderNodeVectorMath")
    number.operation = "SCALE"
    links.new(digits.outputs[0], number.inputs[0])
    links.new(alive, number.inputs["Scale"])
    out = nodes.new("ShaderNodeOutputAOV")
    out.name = "patch"
    links.new(number.outputs["Vector"], out.inputs["Color"])
    return material


def add_mesh(name, chosen, corners, reflectance, exitance, two_sided):
    """One object of the chosen patches. Numbers count from 1, so that 0 is nothing."""
    mesh = bpy.data.meshes.new(name)
    count = len(chosen)
    mesh.vertices.add(3 * count)
    mesh.vertices.foreach_set("co", corners[chosen].astype(numpy.float32).ravel())
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", numpy.arange(3 * count, dtype=numpy.int32))
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, 3 * count, 3, dtype=numpy.int32))
    mesh.polygons.foreach_set("loop_total", numpy.full(count, 3, numpy.int32))
    numbers = chosen + 1
    digits = numpy.stack([numbers % 256, numbers // 256 % 256, numbers // 65536], axis=1)
    for what, values in (("reflectance", reflectance[chosen]), ("emission", exitance[chosen] / math.pi),
                         ("digits", digits)):
        layer = mesh.attributes.new(what, "FLOAT_VECTOR", "FACE")
        layer.data.foreach_set("vector", values.astype(numpy.float32).ravel())
    layer = mesh.attributes.new("two_sided", "FLOAT", "FACE")
    layer.data.foreach_set("value", two_sided[chosen].astype(numpy.float32))
    mesh.materials.append(make_material(bool((exitance[chosen] > 0).any())))
    mesh.update()
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def add_camera(matrix, camera, origin, width, height):
    data = bpy.data.cameras.new("view")
    data.sensor_fit = "VERTICAL"
    if camera["type"] == "perspective":
        aspect = camera["perspective"]["aspectRatio"]
        data.angle_y = camera["perspective"]["yfov"]
    else:
        aspect = camera["orthographic"]["xmag"] / camera["orthographic"]["ymag"]
        data.type = "ORTHO"
        data.ortho_scale = 2 * camera["orthographic"]["ymag"]
    data.clip_start, data.clip_end = 1e-6, 1e9
    item = bpy.data.objects.new("view", data)
    matrix.translation -= mathutils.Vector(origin)
    item.matrix_world = matrix
    scene = bpy.context.scene
    scene.collection.objects.link(item)
    scene.camera = item
    render = scene.render
    render.use_persistent_data = True
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    stretch = aspect * height / width  # of pixels that are not quite square
    render.pixel_aspect_x, render.pixel_aspect_y = max(stretch, 1), max(1 / stretch, 1)


def shift_view(camera, number):
    """By a part of a pixel, spread evenly over it as numbers grow (R2 sequence)."""
    height = bpy.context.scene.render.resolution_y
    shift = [(0.5 + number * step) % 1 - 0.5 for step in (0.7548776662466927, 0.5698402909980532)]
    camera.shift_x, camera.shift_y = shift[0] / height, shift[1] / height


def set_up_cycles(samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", int(os.environ.get("THREADS", "1"))
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.max_bounces = cycles.diffuse_bounces = int(os.environ.get("BOUNCES", "1024"))
    cycles.transparent_max_bounces = 64  # of camera rays alone: nothing else sees through
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01
    cycles.blur_glossy = 0
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    scene.render.film_transparent = False
    layer = scene.view_layers[0]
    aov = layer.aovs.add()
    aov.name, aov.type = "patch", "COLOR"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "ZIP"


def picture_size(folder):
    """Half that of the PNG, from its header: pixels."""
    with open(os.path.join(folder, read_run(folder)["name"] + ".png"), "rb") as file:
        return [side // 2 for side in struct.unpack(">2I", file.read(24)[16:])]


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    folder, out = arguments[:2]
    samples = int(arguments[2]) if len(arguments) > 2 else 2
    seeds = int(arguments[3]) if len(arguments) > 3 else 16
    bpy.ops.wm.read_factory_settings(use_empty=True)
    corners, reflectance, exitance = read_patches(folder)
    matrix, camera, origin = read_view(folder)
    back = find_backs(corners)
    two_sided = numpy.append(back[1:], False)
    corners = corners - numpy.array(origin)
    front = numpy.flatnonzero(~back)
    lit = (exitance[front] > 0).any(axis=1)
    for name, chosen in (("surfaces", front[~lit]), ("lamps", front[lit])):
        if len(chosen):
            add_mesh(name, chosen, corners, reflectance, exitance, two_sided)
    add_camera(matrix, camera, origin, *picture_size(folder))
    set_up_cycles(samples)
    scene = bpy.context.scene
    scene_path = arguments[4] if len(arguments) > 4 else ""
    lights.add_lights(read_run(folder)["options"], scene_path, origin, scene.world)
    for seed in range(1, seeds + 1):
        scene.cycles.seed = seed
        shift_view(scene.camera.data, seed - 1)
        scene.render.filepath = os.path.abspath(os.path.join(out, f"seed_{seed}.exr"))
        bpy.ops.render.render(write_still=True)


main()
