"""Lights. A radiance of 1 W/(sr m²) in Blender is a radiance of 1 in phasetree."""

import math

from mathutils import Vector

from ..passes import group_name

SHARPEST_SUN = 0.01  # degrees


def light_of(item, matrix, notes):
    """The scene file's light for an evaluated light object; None if it is dark."""
    made = light_without_group(item, matrix, notes)
    if made and item.lightgroup:
        for parameters in made.values():
            parameters["group"] = group_name(item.lightgroup)
    return made


def light_without_group(item, matrix, notes):
    light = item.data
    notes = notes.about(f'light "{item.name}"')
    color, power = [max(c, 0.0) for c in light.color], light.energy
    if light.energy < 0:
        notes.unsupported("its power is negative, so it is left out")
    if power <= 0 or not any(color):
        return None
    note_losses(light, notes)
    position, forward = matrix.translation, -matrix.col[2].xyz.normalized()
    if light.type == "SUN":
        diameter = min(max(math.degrees(light.angle), SHARPEST_SUN), 90)
        return {"sun": {"direction": list(-forward), "irradiance": [power * c for c in color], "diameter": diameter}}
    if light.type == "AREA":
        return area(light, matrix, color, notes)
    intensity = power / (4 * math.pi)
    if light.type == "SPOT":
        notes.approximate("the cone is evenly bright; Cycles multiplies by the cosine of the angle from the axis")
        if light.shadow_soft_size > 0:
            notes.approximate("the radius of a spot is ignored, so its shadows are sharp")
        half = light.spot_size / 2
        # Blender's edge is a smooth step of the cosine.
        inner = math.acos(min(math.cos(half) + (1 - math.cos(half)) * light.spot_blend, 1))
        return {"spot": {"position": list(position), "target": list(position + forward), "cone": math.degrees(2 * half),
                         "edge": math.degrees(half - inner), "color": color, "intensity": intensity}}  # fmt: skip
    radius = light.shadow_soft_size
    if radius <= 0:
        return {"point": {"position": list(position), "color": color, "intensity": intensity}}
    return {"sphere": {"centre": list(position), "radius": radius, "radiance": color,
                       "intensity": intensity / (math.pi * radius**2), "visible_to_camera": False}}  # fmt: skip


def area(light, matrix, color, notes):
    """A rectangle. In phasetree, one of its edges is horizontal, and parallel to x if it faces up or down."""
    x, y = matrix.col[0].xyz, matrix.col[1].xyz
    forward = -matrix.col[2].xyz.normalized()
    width = light.size * x.length
    height = (light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size) * y.length
    emitting = width * height
    if light.shape in ("DISK", "ELLIPSE"):
        notes.approximate(f"the {light.shape.lower()} is rendered as a rectangle of the same area")
        emitting *= math.pi / 4
        width, height = width * math.sqrt(math.pi / 4), height * math.sqrt(math.pi / 4)
    if emitting <= 0:
        notes.unsupported("its size is 0, so it is left out")
        return None
    horizontal = forward.cross(Vector((0, 0, 1)))
    horizontal = horizontal.normalized() if horizontal.length > 1e-6 else Vector((1, 0, 0))
    along_x, along_y = abs(horizontal.dot(x.normalized())), abs(horizontal.dot(y.normalized()))
    if along_y > along_x:
        width, height = height, width
    if max(along_x, along_y) < 1 - 1e-4 and light.shape not in ("DISK", "ELLIPSE"):
        notes.approximate("it is turned so that two of its edges are horizontal")
    return {"rectangle": {"centre": list(matrix.translation), "target": list(matrix.translation + forward), "width": width,
                          "height": height, "radiance": color, "intensity": light.energy / (4 * emitting),
                          "visible_to_camera": False}}  # fmt: skip


def note_losses(light, notes):
    for name in ("diffuse_factor", "specular_factor", "volume_factor"):
        if getattr(light, name, 1) != 1:
            notes.unsupported(f'"{name}" is ignored')
    if not getattr(light, "use_shadow", True):
        notes.unsupported("it still casts shadows")
    if light.type == "AREA" and getattr(light, "spread", math.pi) < math.pi - 1e-4:
        notes.unsupported("its spread is ignored")
    if light.type == "SPOT" and light.use_square:
        notes.unsupported("its square cone is rendered as a round one")
    if light.use_nodes and light.node_tree and any(not is_plain(node) for node in light.node_tree.nodes):
        notes.unsupported("its nodes are ignored")


def is_plain(node):
    if node.bl_idname == "ShaderNodeOutputLight":
        return True
    if node.bl_idname != "ShaderNodeEmission" or any(s.is_linked for s in node.inputs):
        return False
    return node.inputs["Strength"].default_value == 1 and all(c == 1 for c in node.inputs["Color"].default_value[:3])
