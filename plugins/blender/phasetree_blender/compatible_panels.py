"""Blender's own panels that this engine uses: lights, cameras, worlds, materials, colour management and so on."""

import bpy

# EEVEE panels that any engine can use. The rest are settings of EEVEE itself.
OF_EEVEE = {
    "EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface", "EEVEE_MATERIAL_PT_volume",
    "EEVEE_WORLD_PT_surface", "EEVEE_WORLD_PT_volume", "DATA_PT_EEVEE_light",
}  # fmt: skip
# Panels for engines without settings of their own.
LEFT_OUT = {"VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes", "RENDER_PT_simplify", "RENDER_PT_gpencil"}


def compatible():
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        if not isinstance(engines, set):
            continue
        if panel.__name__ in OF_EEVEE or ("BLENDER_RENDER" in engines and panel.__name__ not in LEFT_OUT):
            yield engines


def register():
    for engines in compatible():
        engines.add("PHASETREE")


def unregister():
    for engines in compatible():
        engines.discard("PHASETREE")
