"""The camera."""

import math

from mathutils import Vector

from ..notes import TranslationError


def camera_of(camera, depsgraph, width, height, notes):
    """The scene file's camera. `width` and `height` of the whole picture, in pixels."""
    if camera is None:
        raise TranslationError("the scene has no camera; add one, and make it the active camera with Ctrl+Numpad 0")
    if camera.type != "CAMERA":
        raise TranslationError(f'the active camera "{camera.name}" is not a camera')
    evaluated = camera.evaluated_get(depsgraph)
    data, matrix = evaluated.data, evaluated.matrix_world
    notes = notes.about(f'camera "{camera.name}"')
    position, forward, up = matrix.translation, -matrix.col[2].xyz.normalized(), matrix.col[1].xyz.normalized()
    right = matrix.col[0].xyz.normalized()
    fits_width = data.sensor_fit == "HORIZONTAL" or (data.sensor_fit == "AUTO" and width >= height)
    fitted = width if fits_width else height
    if data.type == "ORTHO":
        # A shift of parallel rays is a shift of the camera.
        position = position + data.ortho_scale * (data.shift_x * right + data.shift_y * up)
        if data.dof.use_dof:
            notes.unsupported("depth of field of an orthographic camera is ignored")
        return {"orthographic": {**view(position, forward, up), "height": data.ortho_scale * height / fitted}}
    if data.type == "PANO":
        return panorama(data, view(position, forward, up), width, height, notes)
    if data.type != "PERSP":
        raise TranslationError(f'the camera "{camera.name}" is {data.type.lower()}; use a perspective or orthographic one')
    sensor = data.sensor_height if data.sensor_fit == "VERTICAL" else data.sensor_width
    tangent = sensor / (2 * data.lens) * height / fitted
    lens = {**view(position, forward, up), "fov": math.degrees(2 * math.atan(tangent))}
    lens.update(focus_of(data, position, forward, notes))
    if data.shift_x == 0 and data.shift_y == 0:
        return {"thin_lens": lens}
    return {"tilt_shift": {**lens, "shift": [data.shift_x * fitted / height, data.shift_y * fitted / height]}}


def panorama(data, seen, width, height, notes):
    """An equirectangular picture of all directions, or an equidistant fisheye."""
    settings = data if hasattr(data, "panorama_type") else data.cycles  # Cycles' until Blender 5
    if data.dof.use_dof:
        notes.unsupported("depth of field of a panoramic camera is ignored")
    if settings.panorama_type == "EQUIRECTANGULAR":
        limits = (settings.longitude_min, settings.longitude_max, settings.latitude_min, settings.latitude_max)
        if any(abs(a - b) > 1e-4 for a, b in zip(limits, (-math.pi, math.pi, -math.pi / 2, math.pi / 2))):
            notes.unsupported("limits of longitude and latitude are ignored: a panorama shows all directions")
        return {"panorama": seen}
    if settings.panorama_type == "FISHEYE_EQUIDISTANT":
        if width != height:
            notes.approximate("a fisheye is a circle in the middle of the picture, not an ellipse")
        return {"dome": {**seen, "fov": min(math.degrees(settings.fisheye_fov), 360)}}
    kind = settings.panorama_type.replace("_", " ").lower()
    raise TranslationError(f"the camera's panorama is of the type {kind}; use Equirectangular or Fisheye Equidistant")


def view(position, forward, up):
    return {"position": list(position), "look_at": list(position + forward), "up": list(up)}


def focus_of(data, position, forward, notes):
    """The parameters for depth of field."""
    dof = data.dof
    if not dof.use_dof or dof.aperture_fstop <= 0:
        return {}
    distance = dof.focus_distance
    if dof.focus_object is not None:
        distance = abs((Vector(dof.focus_object.matrix_world.translation) - position).dot(forward))
    if distance <= 0:
        notes.unsupported("the focus distance is 0, so depth of field is ignored")
        return {}
    if dof.aperture_ratio != 1:
        notes.unsupported("the aperture's ratio is ignored")
    # The lens is in millimetres, and Blender's unit is the metre here.
    focus = {"lens_radius": data.lens / 1000 / (2 * dof.aperture_fstop), "focus_distance": distance}
    if dof.aperture_blades >= 3:
        focus["blades"], focus["blade_rotation"] = dof.aperture_blades, math.degrees(dof.aperture_rotation)
    return focus
