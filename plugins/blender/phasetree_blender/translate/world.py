"""The world as a light at infinity."""

import math
import os

import bpy

from ..passes import group_name
from . import images, sockets
from .sockets import constant

DARK = {"constant": {"radiance": [0, 0, 0]}}
# Blender's environment maps show +x in their middle, and phasetree's +y.
MIDDLE = 90.0


def world_light(world, folder, notes):
    """The scene file's light. Files that it needs are written to the folder."""
    if world is None:
        return DARK
    made = light_of(world, folder, notes.about(f'world "{world.name}"'))
    if world.lightgroup:
        made = {kind: {**parameters, "group": group_name(world.lightgroup)} for kind, parameters in made.items()}
    return made


def light_of(world, folder, notes):
    if not world.use_nodes or world.node_tree is None:
        return constant_light(tuple(world.color), 1)
    output = world.node_tree.get_output_node("ALL")
    shader = sockets.source(output.inputs["Surface"]) if output else None
    if output and sockets.source(output.inputs["Volume"]):
        notes.unsupported("the world's volume is ignored")
    if shader is None:
        return DARK
    if shader.node.bl_idname not in ("ShaderNodeBackground", "ShaderNodeEmission"):
        notes.unsupported(f"the shader {shader.node.name}; the viewport colour of the world is used")
        return constant_light(tuple(world.color), 1)
    strength = max(constant(shader.node, "Strength", 1.0, notes), 0.0)
    origin = sockets.source(shader.node.inputs["Color"])
    if origin is not None and origin.node.bl_idname == "ShaderNodeTexEnvironment" and origin.node.image is not None:
        return image_light(origin.node, strength, folder, notes)
    if origin is not None and origin.node.bl_idname == "ShaderNodeTexSky":
        return sky_light(origin.node, strength, notes)
    return constant_light(constant(shader.node, "Color", (1.0, 1.0, 1.0), notes), strength)


def constant_light(color, strength):
    return {"constant": {"radiance": [max(c, 0.0) for c in color], "intensity": strength}}


def image_light(node, strength, folder, notes):
    file = file_of(node.image, folder)
    if file is None:
        notes.unsupported(f'the image "{node.image.name}" cannot be read; the world is dark')
        return DARK
    if node.projection != "EQUIRECTANGULAR":
        notes.unsupported("a mirror ball is used as an equirectangular image")
    return {"image": {"file": file, "rotation": MIDDLE + turn_of(node, notes), "intensity": strength}}


# Light on level ground below Blender's sky, divided by that below phasetree's, with the sun 45° high.
SKY_SCALE = {"PREETHAM": 2.1, "HOSEK_WILKIE": 0.3}
SKY_SCALE_WITH_SUN, SKY_SCALE_WITHOUT_SUN = 30.0, 15.0  # of Nishita's model and its successors


def sky_light(node, strength, notes):
    """phasetree's own model of a clear sky, with the sun in the same place, and as bright on level ground."""
    if node.sky_type in SKY_SCALE:
        toward = node.sun_direction.normalized()
        elevation, azimuth = math.asin(min(max(toward.z, -1), 1)), math.atan2(toward.x, toward.y)
        sky, scale = {"turbidity": min(max(node.turbidity, 1), 10), "sun": False}, SKY_SCALE[node.sky_type]
    else:
        elevation, azimuth = node.sun_elevation, node.sun_rotation
        sky = {"turbidity": min(max(1 + node.dust_density, 1), 10), "sun": node.sun_disc,
               "sun_diameter": min(max(math.degrees(node.sun_size), 0.01), 90)}  # fmt: skip
        scale = SKY_SCALE_WITH_SUN if node.sun_disc else SKY_SCALE_WITHOUT_SUN
        if node.sun_disc and node.sun_intensity != 1:
            notes.unsupported(f"the intensity of the sun of {node.name} is ignored")
    notes.approximate(f"{node.name} is rendered by another model of the atmosphere")
    if sockets.source(node.inputs.get("Vector")):
        notes.unsupported(f"what is linked to {node.name} is ignored")
    return {"sky": {"sun_elevation": math.degrees(elevation), "sun_azimuth": math.degrees(azimuth), **sky,
                    "intensity": scale * strength}}  # fmt: skip


def turn_of(node, notes):
    """The angle in degrees by which a Mapping node turns the image about z, clockwise as seen from above."""
    origin = sockets.source(node.inputs["Vector"])
    if origin is None:
        return 0.0
    mapping = origin.node
    if mapping.bl_idname == "ShaderNodeTexCoord" and origin.name == "Generated":
        return 0.0
    if mapping.bl_idname != "ShaderNodeMapping" or mapping.vector_type == "NORMAL":
        notes.unsupported(f"{mapping.name} at the environment's image is ignored")
        return 0.0
    before = sockets.source(mapping.inputs["Vector"])
    if before is None or before.node.bl_idname != "ShaderNodeTexCoord" or before.name != "Generated":
        notes.unsupported(f'{mapping.name} is used as if the "Generated" coordinates were linked to it')
    x, y, z = constant(mapping, "Rotation", (0.0, 0.0, 0.0), notes)
    location = constant(mapping, "Location", (0.0, 0.0, 0.0), notes) if "Location" in mapping.inputs else (0, 0, 0)
    scale = constant(mapping, "Scale", (1.0, 1.0, 1.0), notes)
    if x or y or any(location) or any(s != 1 for s in scale):
        notes.unsupported(f"of {mapping.name}, only the rotation about z is used")
    return math.degrees(z) * (-1 if mapping.vector_type == "TEXTURE" else 1)


def file_of(image, folder):
    path = bpy.path.abspath(image.filepath, library=image.library) if image.filepath else ""
    if image.source == "FILE" and image.packed_file is None and not image.is_dirty and os.path.isfile(path):
        return path
    content = images.stored_bytes(image)
    name = os.path.join(folder, "world" + (os.path.splitext(image.filepath)[1] or ".hdr" if content else ".hdr"))
    if content is None:
        content = images.radiance_of(image)
    if content is None:
        return None
    with open(name, "wb") as file:
        file.write(content)
    return name
