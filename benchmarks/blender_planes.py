# Opens an EXR file with planes in Blender's compositor (3.4 was tried), and writes what its nodes make of it as PNG
# files: every pass, and for each Cryptomatte layer the matte of each name. This shows that another program reads the
# names of channels, the attributes and the numbers as they are meant; the test tests/tracer/film/planes.cpp reads them, too.
# A file of one plane, a.depth.exr, shows the pass of that plane; one without a Cryptomatte says that there is "no layer".
#
#   phasetree render scenes/hourglass.json --planes all -o planes.exr -o 'a.{plane}.exr'
#   blender --background --factory-startup --python benchmarks/blender_planes.py -- planes.exr FOLDER
#
# Needs Debian's package `blender`, which nothing else here does.
import os
import sys

import bpy

file, folder = sys.argv[sys.argv.index("--") + 1:][:2]
folder = os.path.abspath(folder)
image = bpy.data.images.load(os.path.abspath(file))
scene = bpy.context.scene
scene.use_nodes = True
scene.render.engine = "CYCLES"
scene.cycles.samples = 1
scene.render.resolution_percentage = 100
scene.view_settings.view_transform = "Standard"
tree = scene.node_tree
tree.nodes.clear()
source = tree.nodes.new("CompositorNodeImage")
source.image = image
width, height = (int(n) for n in os.environ.get("SIZE", "0x0").split("x"))
scene.render.resolution_x = width or image.size[0] or 400
scene.render.resolution_y = height or image.size[1] or 300

written = tree.nodes.new("CompositorNodeOutputFile")
written.base_path = folder
written.format.file_format = "PNG"
written.file_slots.clear()


def write(socket, name, normalised=False):
    if normalised:
        normalise = tree.nodes.new("CompositorNodeNormalize")
        tree.links.new(socket, normalise.inputs[0])
        socket = normalise.outputs[0]
    written.file_slots.new(name + "_")
    tree.links.new(socket, written.inputs[-1])


for output in source.outputs:
    print("pass", output.name, output.type)
    if output.enabled and not output.name.startswith("Crypto"):
        write(output, "pass_" + output.name.replace(" ", "_"), normalised=output.type == "VALUE")

node = tree.nodes.new("CompositorNodeCryptomatteV2")
node.source = "IMAGE"
node.image = image
layers = [item.identifier for item in node.bl_rna.properties["layer_name"].enum_items] or []
for layer in ("CryptoPhase", "CryptoObject", "CryptoMaterial"):
    for name in os.environ.get("NAMES", "vacuum").split(","):
        matte = tree.nodes.new("CompositorNodeCryptomatteV2")
        matte.source = "IMAGE"
        matte.image = image
        try:
            matte.layer_name = layer
        except TypeError as error:
            print("no layer", layer, error)
            continue
        matte.matte_id = name
        print("layer", layer, "matte", name, "entries", [e.name for e in matte.entries] if hasattr(matte, "entries") else "")
        write(matte.outputs["Matte"], f"matte_{layer}_{name}")
composite = tree.nodes.new("CompositorNodeComposite")
tree.links.new(source.outputs[0], composite.inputs[0])
bpy.ops.render.render()
