"""Values of shader nodes' inputs, for the names of sockets in Blender 3.4 and 4."""

# Principled BSDF sockets that have other names in Blender 4.
NEW_NAMES = {
    "Transmission": "Transmission Weight",
    "Specular": "Specular IOR Level",
    "Emission": "Emission Color",
    "Subsurface": "Subsurface Weight",
    "Sheen": "Sheen Weight",
    "Clearcoat": "Coat Weight",
    "Clearcoat Roughness": "Coat Roughness",
    "Clearcoat Normal": "Coat Normal",
}


def socket(node, name):
    """The input of that name (in Blender 3.4), or None."""
    return node.inputs.get(name) or node.inputs.get(NEW_NAMES.get(name, name))


def source(socket):
    """The output that a socket is linked to, through reroutes; None if it is not linked."""
    seen = 0
    while socket is not None and socket.is_linked and socket.links and seen < 100:
        link = socket.links[0]
        if getattr(link, "is_muted", False):
            return None
        if link.from_node.bl_idname != "NodeReroute":
            return link.from_socket
        socket, seen = link.from_node.inputs[0], seen + 1
    return None


def plain(value):
    """A socket's value as a float, or as a tuple without alpha."""
    return float(value) if isinstance(value, (int, float)) else tuple(float(v) for v in value)[:3]


def constant(node, name, default, notes):
    """The value of an input. Notes that a link to anything but a constant is ignored."""
    found = socket(node, name)
    if found is None:
        return default
    origin = source(found)
    if origin is None:
        return plain(found.default_value)
    if origin.node.bl_idname in ("ShaderNodeValue", "ShaderNodeRGB"):
        value = plain(origin.default_value)
        if isinstance(value, tuple) == isinstance(default, tuple):
            return value
    notes.unsupported(f'"{found.name}" is linked to {origin.node.name}, which is ignored; the value {shown(found)} is used')
    return plain(found.default_value)


def shown(socket):
    value = plain(socket.default_value)
    return f"({', '.join(f'{v:.3g}' for v in value)})" if isinstance(value, tuple) else f"{value:.3g}"
