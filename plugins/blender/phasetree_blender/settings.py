"""Settings of scenes, view layers and objects, which are saved in .blend files."""

import bpy
from bpy.props import (
    BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty,
)  # fmt: skip


class PhasetreeSceneSettings(bpy.types.PropertyGroup):
    samples: IntProperty(name="Samples", description="Samples per pixel", default=64, min=1, max=16777216, soft_max=4096)
    seed: IntProperty(name="Seed", description="Seed of the random numbers; another seed gives other noise", default=0, min=0)
    max_depth: IntProperty(
        name="Max Surfaces",
        description="Maximum number of surfaces and scattering events per path; 0 for the default, 65536",
        default=0, min=0, max=1048576,
    )  # fmt: skip
    caustics: BoolProperty(
        name="Caustics",
        description="Use photons for light that reaches surfaces through clear objects or by metal. Without them, point "
        "and spot lights do not shine through glass",
        default=True,
    )
    guiding: BoolProperty(
        name="Path Guiding", description="Learn where light comes from before the first sample, for rooms lit indirectly"
    )
    spectral: BoolProperty(name="Spectral", description="Render with wavelengths instead of red, green and blue")
    denoise: BoolProperty(name="Denoise", description="Denoise the finished picture")
    closes_gaps: BoolProperty(
        name="Close Gaps",
        description="Extend a liquid to the glass across a thin gap along a tenth of a surface or more",
        default=True,
    )
    update_interval: FloatProperty(
        name="Update Interval",
        description="Time between two updates of the picture while it renders; 0 shows only the finished picture",
        default=3,
        min=0,
        max=3600,
        subtype="TIME_ABSOLUTE",
        unit="TIME_ABSOLUTE",
    )
    keeps_checkpoints: BoolProperty(
        name="Resume",
        description="Keep a checkpoint of each frame. A render that was cancelled goes on from it, and one that is complete "
        "goes on when Samples grows. A changed scene starts again",
    )
    checkpoint_folder: StringProperty(
        name="Folder", description="Folder of the checkpoints", default="//phasetree_checkpoints", subtype="DIR_PATH"
    )
    motion_blur_position: EnumProperty(
        name="Position",
        description="When the shutter is open",
        items=(
            ("START", "Start on Frame", "The shutter opens at the frame"),
            ("CENTER", "Center on Frame", "The shutter is open around the frame"),
            ("END", "End on Frame", "The shutter closes at the frame"),
        ),
        default="CENTER",
    )
    motion_steps: IntProperty(
        name="Steps", description="Number of times at which positions of moving objects are read; more follow curves better",
        default=3, min=2, soft_max=9, max=65,
    )  # fmt: skip
    viewport_scale: IntProperty(
        name="Viewport Scale",
        description="Resolution of the rendered viewport, in percent of its width and height",
        default=50,
        min=5,
        max=100,
        subtype="PERCENTAGE",
    )


class PhasetreeViewLayerSettings(bpy.types.PropertyGroup):
    use_pass_albedo: BoolProperty(name="Albedo", description="Albedo of the first surface")


class PhasetreeNumber(bpy.types.PropertyGroup):
    """A number of an object's tree. Its value is the object's custom property of that name."""

    pointer: StringProperty(name="Path", description="Its place in the scene file, such as /shapes/bowl/sphere/radius")


class PhasetreeObjectSettings(bpy.types.PropertyGroup):
    source: EnumProperty(
        name="Tree",
        description="Where the tree comes from that is rendered instead of the mesh",
        items=(
            ("NONE", "None", "An ordinary object: its mesh is rendered"),
            ("FILE", "Scene File", "The tree and the materials of a scene file"),
            ("TEXT", "Python", "The object of phases that the function `tree` in a text block returns"),
        ),
        default="NONE",
    )
    file: StringProperty(name="Scene File", description="A scene file of phasetree", subtype="FILE_PATH")
    text: PointerProperty(name="Text", description="Python code that defines a function `tree`", type=bpy.types.Text)
    numbers: CollectionProperty(type=PhasetreeNumber)
    detail: IntProperty(
        name="Detail", description="Grid points along the longest side of the mesh that the viewport shows", default=64, min=8,
        max=1024, soft_max=256,
    )  # fmt: skip
    role: EnumProperty(
        name="Role",
        description="What a clear object is",
        items=(
            ("AUTOMATIC", "Automatic", "Solid, liquid or gas by the name of the object, its material or the index"),
            ("SOLID", "Solid", "Keeps its space where it overlaps a liquid or a gas"),
            ("LIQUID", "Liquid", "Yields to solids and gases that overlap it, and is extended to the glass across thin gaps"),
            ("GAS", "Gas", "Keeps its space where it overlaps a liquid, such as a bubble"),
            ("OPAQUE", "Opaque", "Rendered as an opaque mesh, although its material is clear"),
        ),
        default="AUTOMATIC",
    )
    priority: FloatProperty(
        name="Priority", description="Where two clear objects overlap, the one with the higher priority keeps the space"
    )


def items_of(first, names):
    """Choices for an EnumProperty: the shader nodes, and names of the scene file."""
    return (first, *((name.upper(), name.replace("_", " ").capitalize(), "") for name in names.split()))


class PhasetreeMaterialSettings(bpy.types.PropertyGroup):
    medium: EnumProperty(
        name="Medium",
        description="The medium inside a clear object, which absorbs and scatters light",
        items=items_of(
            ("NODES", "From Volume", "The material's volume shader"),
            "apple chicken1 chicken2 cream ketchup marble potato skim_milk skin1 skin2 spectralon whole_milk",
        ),
        default="NODES",
    )
    glass: EnumProperty(
        name="Index",
        description="A substance with a measured index for each wavelength, which disperses light like a prism. Only for smooth "
        "clear objects",
        items=items_of(
            ("NODES", "From Surface", "The index of refraction given in the shader"),
            "bk7 diamond f2 fused_silica sapphire sf11 water",
        ),
        default="NODES",
    )


CLASSES = (PhasetreeSceneSettings, PhasetreeViewLayerSettings, PhasetreeObjectSettings, PhasetreeMaterialSettings)
PARTS = (PhasetreeNumber,)  # of the groups above
OWNERS = ((bpy.types.Scene, CLASSES[0]), (bpy.types.ViewLayer, CLASSES[1]), (bpy.types.Object, CLASSES[2]),
          (bpy.types.Material, CLASSES[3]))  # fmt: skip


def register():
    for group in (*PARTS, *CLASSES):
        bpy.utils.register_class(group)
    for owner, group in OWNERS:
        owner.phasetree = PointerProperty(type=group)


def unregister():
    for owner, _ in OWNERS:
        del owner.phasetree
    for group in reversed((*PARTS, *CLASSES)):
        bpy.utils.unregister_class(group)
