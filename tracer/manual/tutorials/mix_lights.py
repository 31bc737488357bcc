"""Mix the light groups of the tutorial "a picture for print" in Blender's compositor.

    blender --background --factory-startup --python-exit-code 1 --python mix_lights.py

Reads cup.light_key.exr, cup.light_rim.exr and cup.light_fill.exr, and the size of cup.beauty.exr, from the working
directory, and writes evening.png there. Tested with Blender 3.4.
"""

import os

import bpy

# Factors of red, green and blue.
layers = {"key": (0.55, 0.5, 0.42), "rim": (1.6, 1.6, 1.6), "fill": (1.2, 1.2, 1.2)}

scene = bpy.context.scene
scene.use_nodes = True
nodes, links = scene.node_tree.nodes, scene.node_tree.links
nodes.clear()


def mixed(kind: str, first, second):
    """The output of a node that combines two colours."""
    node = nodes.new("CompositorNodeMixRGB")
    node.blend_type = kind
    links.new(first, node.inputs[1])
    if hasattr(second, "is_output"):
        links.new(second, node.inputs[2])
    else:
        node.inputs[2].default_value = (*second, 1)
    return node.outputs[0]


total = None
for name, factors in layers.items():
    image = nodes.new("CompositorNodeImage")
    image.image = bpy.data.images.load(os.path.abspath(f"cup.light_{name}.exr"))
    color_space = image.image.colorspace_settings
    color_spaces = color_space.bl_rna.properties["name"].enum_items.keys()
    color_space.name = "Linear Rec.709" if "Linear Rec.709" in color_spaces else "Linear"  # the name before Blender 4
    # The only output. Its name is that of the plane, because the file's channels are light_key.R and so on.
    light = mixed("MULTIPLY", image.outputs[0], factors)
    total = mixed("ADD", total, light) if total else light

width, height = bpy.data.images.load(os.path.abspath("cup.beauty.exr")).size
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.resolution_percentage = 100
scene.view_settings.view_transform = "Standard"
output = nodes.new("CompositorNodeComposite")
links.new(total, output.inputs["Image"])
scene.render.image_settings.file_format = "PNG"
scene.render.image_settings.color_mode = "RGB"
scene.render.image_settings.color_depth = "16"
scene.render.filepath = os.path.abspath("evening")
bpy.ops.render.render(write_still=True)
