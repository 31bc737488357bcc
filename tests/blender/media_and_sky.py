"""Volumes within clear objects, measured media and indices, the sky, panoramas, light groups and Cryptomatte."""

import math
import unittest

import bpy
import numpy as np
from phasetree_blender import cryptomatte, exr
from support import BlenderTest, add_box, dress, principled, shader


def add_node(tree, kind, to, **values):
    """Adds a node whose first output is linked to an input."""
    made = tree.nodes.new(kind)
    for name, value in values.items():
        made.inputs[name.replace("_", " ")].default_value = (*value, 1) if isinstance(value, tuple) else value
    tree.links.new(made.outputs[0], to)
    return made


def scatter(tree, to):
    add_node(tree, "ShaderNodeVolumeScatter", to, Color=(0.5, 0.7, 0.9), Density=1.5, Anisotropy=0.4)


def principled_volume(tree, to):
    add_node(tree, "ShaderNodeVolumePrincipled", to, Color=(0.5, 0.7, 0.9), Density=1.5, Anisotropy=0.4,
             Absorption_Color=(0.25, 0.04, 0.0))  # fmt: skip


def mixed(tree, to):
    mix = add_node(tree, "ShaderNodeMixShader", to, Fac=0.3)
    add_node(tree, "ShaderNodeVolumeScatter", mix.inputs[1], Color=(0.8, 0.8, 0.8), Density=1.0, Anisotropy=-0.3)
    add_node(tree, "ShaderNodeVolumeAbsorption", mix.inputs[2], Color=(0.4, 0.6, 0.9), Density=0.7)


def two_lobes(tree, to):
    mix = add_node(tree, "ShaderNodeMixShader", to, Fac=0.3)
    for number, anisotropy in ((1, 0.7), (2, -0.5)):
        add_node(tree, "ShaderNodeVolumeScatter", mix.inputs[number], Color=(0.8, 0.8, 0.8), Density=1.2,
                 Anisotropy=anisotropy)  # fmt: skip


class AgainstCycles(BlenderTest):
    def setUp(self):
        super().setUp()
        bpy.data.objects.remove(bpy.data.objects["Cube"])
        bpy.data.objects["Light"].data.energy = 0
        self.scene.render.resolution_x, self.scene.render.resolution_y = 32, 24
        self.scene.phasetree.samples = self.scene.cycles.samples = 48
        self.scene.cycles.use_denoising = self.scene.cycles.use_adaptive_sampling = False
        self.world = self.scene.world.node_tree
        self.background = self.world.nodes["Background"].inputs
        self.background["Color"].default_value, self.background["Strength"].default_value = (1, 1, 1, 1), 1

    def by_both(self):
        """The pictures of Cycles and of phasetree."""
        found = []
        for engine in ("CYCLES", "PHASETREE"):
            self.scene.render.engine = engine
            found.append(self.combined())
        return found

    def test_media(self):
        """In a box whose index is that of air. Cycles loses 2 % of the light of a medium that absorbs nothing."""
        self.scene.cycles.max_bounces = self.scene.cycles.volume_bounces = self.scene.cycles.transmission_bounces = 256
        for make in (scatter, principled_volume, mixed, two_lobes):
            with self.subTest(make.__name__):
                air = shader("ShaderNodeBsdfGlass", Color=(1.0, 1.0, 1.0), Roughness=0.0, IOR=1.0001)
                box = add_box("Box", (-1.5, -1.5, -1.5), (1.5, 1.5, 1.5), air)
                make(air.node_tree, air.node_tree.nodes["Material Output"].inputs["Volume"])
                cycles, ours = (picture[8:16, 11:21].mean(axis=(0, 1)) for picture in self.by_both())
                np.testing.assert_allclose(ours, cycles, rtol=0.06)
                bpy.data.objects.remove(box)

    def add_sky(self, kind, elevation, rotation=0.0):
        sky = add_node(self.world, "ShaderNodeTexSky", self.background["Color"])
        sky.sky_type, sky.sun_elevation, sky.sun_rotation = kind, math.radians(elevation), math.radians(rotation)
        return sky

    def test_level_ground_is_as_bright_below_the_sky(self):
        """Models of the atmosphere differ, above all in colour."""
        bpy.ops.mesh.primitive_plane_add(size=200)
        dress(bpy.context.object, shader("ShaderNodeBsdfDiffuse", Color=(1.0, 1.0, 1.0)))
        self.scene.phasetree.samples = self.scene.cycles.samples = 4
        for kind, tolerance in (("NISHITA", 0.1), ("PREETHAM", 0.3), ("HOSEK_WILKIE", 0.3)):
            with self.subTest(kind):
                sky = self.add_sky(kind, 45)
                sky.sun_direction = (0, math.sqrt(0.5), math.sqrt(0.5))
                cycles, ours = (picture.mean() for picture in self.by_both())
                self.assertLess(abs(ours / cycles - 1), tolerance)
        self.assertIn("another model of the atmosphere", self.notes())

    def test_the_sun_of_the_sky_is_in_the_same_place(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=2)
        bpy.ops.object.shade_smooth()
        dress(bpy.context.object, shader("ShaderNodeBsdfDiffuse"))
        for rotation in (60, 200):
            self.add_sky("NISHITA", 30, rotation)
            cycles, ours = self.by_both()
            self.assertGreater(np.corrcoef(cycles[..., 1].ravel(), ours[..., 1].ravel())[0, 1], 0.98)

    def test_panoramas(self):
        """Of an image of the world, which no object hides. Pixels between its squares differ."""
        image = bpy.data.images.new("sky", 64, 32, float_buffer=True)
        pixels, (rows, columns) = np.ones((32, 64, 4), dtype=np.float32), np.mgrid[0:32, 0:64]
        pixels[..., 0], pixels[..., 1], pixels[..., 2] = columns / 63, rows / 31, (columns - rows) / 63 + 0.5
        image.pixels.foreach_set(pixels.reshape(-1))
        add_node(self.world, "ShaderNodeTexEnvironment", self.background["Color"]).image = image
        bpy.ops.mesh.primitive_plane_add(size=0.001, location=(0, 0, 1000))
        camera = self.scene.camera
        camera.data.type, camera.rotation_euler = "PANO", (1.2, 0.3, 0.7)
        for kind, size in (("EQUIRECTANGULAR", (48, 24)), ("FISHEYE_EQUIDISTANT", (32, 32))):
            with self.subTest(kind):
                camera.data.cycles.panorama_type, camera.data.cycles.fisheye_fov = kind, math.radians(150)
                self.scene.render.resolution_x, self.scene.render.resolution_y = size
                cycles, ours = self.by_both()
                # Neither shows anything outside the circle of a fisheye.
                y, x = np.mgrid[0 : size[1], 0 : size[0]]
                inside = np.hypot(x - size[0] / 2 + 0.5, y - size[1] / 2 + 0.5) < size[0] / 2 - 2 if "FISHEYE" in kind else x >= 0
                error = np.abs(cycles - ours)[inside].max(axis=-1)
                self.assertLess(np.median(error), 0.01)
                self.assertLess(np.quantile(error, 0.9), 0.05)
        camera.data.cycles.panorama_type = "MIRRORBALL"
        with self.assertRaisesRegex(RuntimeError, "of the type mirrorball; use Equirectangular or Fisheye Equidistant"):
            self.render()


class Media(BlenderTest):
    def test_measured_media_replace_volumes(self):
        milk = principled("Milk", 1, Roughness=0.0, IOR=1.35)
        add_node(milk.node_tree, "ShaderNodeVolumeAbsorption", milk.node_tree.nodes["Material Output"].inputs["Volume"])
        dress(bpy.data.objects["Cube"], milk)
        milk.phasetree.medium = "WHOLE_MILK"
        self.scene.unit_settings.scale_length = 0.01
        _, scene = self.export()
        self.assertEqual(scene["phases"]["Milk"], {"clear": {"ior": 1.35, "medium": "whole_milk", "scale": 10.0}})
        self.assertIn("is overridden by the measured medium whole_milk", self.notes())
        self.assertGreater(self.combined().std(), 0.01)

    def test_measured_indices(self):
        gem = principled("Gem", 1, Base_Color=(1.0, 1.0, 1.0), Roughness=0.0, IOR=2.4)
        dress(bpy.data.objects["Cube"], gem)
        gem.phasetree.glass = "DIAMOND"
        _, scene = self.export()
        self.assertEqual((scene["phases"]["Gem"], scene["render"]["spectral"]), ({"clear": {"glass": "diamond"}}, True))
        gem.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.5
        _, scene = self.export()
        self.assertEqual(scene["phases"]["Gem"]["clear"]["ior"], 2.4)
        self.assertIn("the measured index is ignored", self.notes())

    def test_every_measured_substance_is_one_of_the_command(self):
        settings = bpy.types.Material.bl_rna.properties["phasetree"].fixed_type.properties
        gem = principled("Gem", 1, Roughness=0.0)
        dress(bpy.data.objects["Cube"], gem)
        for name in ("medium", "glass"):
            for item in settings[name].enum_items:
                setattr(gem.phasetree, name, item.identifier)
                path, _ = self.export()
                self.run_command("check", path)
            setattr(gem.phasetree, name, "NODES")


class Passes(BlenderTest):
    def setUp(self):
        super().setUp()
        self.layer = self.scene.view_layers[0]
        dress(bpy.data.objects["Cube"], principled("Wood (old)", Base_Color=(0.4, 0.2, 0.1)))
        add_box("Ice", (0.5, -3, -1), (2.5, -1, 1), principled("Ice", 1, Roughness=0.0, IOR=1.31))

    def test_light_groups(self):
        for name in ("Key light", "Sky"):
            self.layer.lightgroups.add(name=name)
        bpy.data.objects["Light"].lightgroup, self.scene.world.lightgroup = "Key light", "Sky"
        pixels = self.render()
        combined, key, sky = (np.stack([pixels[f"ViewLayer.{p}.{c}"] for c in "RGB"])
                              for p in ("Combined", "Combined_Key light", "Combined_Sky"))  # fmt: skip
        np.testing.assert_allclose(key + sky, combined, rtol=1e-4, atol=1e-6)
        self.assertGreater(min(key.mean(), sky.mean()), 0.001)
        bpy.data.objects["Light"].data.energy = 0
        np.testing.assert_allclose(np.moveaxis(self.combined(), -1, 0).mean(), sky.mean(), rtol=0.05)

    def test_cryptomatte_finds_materials_by_their_names(self):
        self.layer.use_pass_cryptomatte_material = True
        self.scene.render.film_transparent = True
        pixels = self.render()
        _, attributes = exr.read_with_attributes(self.scene.render.filepath)
        manifests = [v.decode() for k, v in attributes.items() if k.startswith("cryptomatte/") and k.endswith("manifest")]
        self.assertTrue(any("Wood (old)" in m for m in manifests), attributes.keys())
        for material, is_hidden in (("Wood (old)", False), ("Ice", False), ("wood", True)):
            with self.subTest(material):
                coverage = np.zeros_like(pixels["ViewLayer.Combined.R"])
                for i in range(3):
                    for identity, share in ("RG", "BA"):
                        ids = pixels[f"ViewLayer.CryptoMaterial0{i}.{identity}"].view(np.uint32)
                        coverage += np.where(ids == cryptomatte.id_of(material), pixels[f"ViewLayer.CryptoMaterial0{i}.{share}"], 0)
                self.assertEqual(coverage.max() > 0.9, not is_hidden)
                np.testing.assert_allclose(self.matte(material), coverage, atol=1e-3)

    def matte(self, material):
        """The matte of Blender's Cryptomatte node."""
        self.scene.use_nodes = True
        tree = self.scene.node_tree
        tree.nodes.clear()
        node, output = tree.nodes.new("CompositorNodeCryptomatteV2"), tree.nodes.new("CompositorNodeComposite")
        node.scene = self.scene
        tree.links.new(tree.nodes.new("CompositorNodeRLayers").outputs["Image"], node.inputs["Image"])  # for its size
        node.layer_name, node.matte_id = "ViewLayer.CryptoMaterial", material
        tree.links.new(node.outputs["Matte"], output.inputs["Image"])
        self.scene.render.image_settings.file_format = "OPEN_EXR"
        self.scene.render.filepath = str(self.folder / "matte.exr")
        bpy.ops.render.render(write_still=True)
        self.scene.use_nodes = False
        return exr.read(self.scene.render.filepath)["R"]

    def test_hashes_are_those_of_the_specification(self):
        """Values of the reference implementation of MurmurHash3."""
        for text, value in (("", 0), ("hello", 0x248BFA47), ("hello, world", 0x149BBB7F), ("The quick brown fox jumps over the lazy dog", 0x2E4FF723)):
            self.assertEqual(cryptomatte.murmur3(text.encode()), value)


if __name__ == "__main__":
    unittest.main()
