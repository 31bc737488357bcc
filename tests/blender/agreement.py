"""Lights, cameras and surfaces are as bright as in Cycles, whose units are Blender's."""

import math
import unittest

import bpy
import numpy as np
from support import BlenderTest, dress, principled, shader


def image_of(values, is_data):
    """An image of numbers: grey (height, width) or colours (height, width, 3), the lowest row first."""
    height, width = values.shape[:2]
    image = bpy.data.images.new("numbers", width, height)
    image.colorspace_settings.name = "Non-Color" if is_data else "sRGB"
    pixels = np.ones((height, width, 4), dtype=np.float32)
    pixels[..., :3] = values if values.ndim == 3 else values[..., None]
    image.pixels.foreach_set(pixels.reshape(-1))
    image.update()
    return image


class Agreement(BlenderTest):
    """Compares means over quarters of the picture. Tolerances are relative; they allow for noise unless a comment says more."""

    def setUp(self):
        super().setUp()
        bpy.data.objects.remove(bpy.data.objects["Cube"])
        self.background = self.scene.world.node_tree.nodes["Background"].inputs
        self.background["Strength"].default_value = 0
        self.light = bpy.data.objects["Light"]
        self.scene.render.resolution_x, self.scene.render.resolution_y = 32, 24
        self.scene.phasetree.samples = self.scene.cycles.samples = 16
        self.scene.cycles.use_denoising = self.scene.cycles.use_adaptive_sampling = False

    def quarters(self, engine):
        self.scene.render.engine = engine
        picture = self.combined()
        self.scene.render.engine = "PHASETREE"
        return picture.reshape(2, 12, 2, 16, 3).mean(axis=(1, 3))

    def assert_agrees(self, tolerance=0.02):
        cycles, ours = self.quarters("CYCLES"), self.quarters("PHASETREE")
        self.assertGreater(cycles.max(), 0.01)
        np.testing.assert_allclose(ours, cycles, rtol=tolerance, atol=tolerance * cycles.mean())

    def add_floor(self):
        bpy.ops.mesh.primitive_plane_add(size=200)
        dress(bpy.context.object, shader("ShaderNodeBsdfDiffuse", Color=(0.5, 0.5, 0.5)))

    def test_lights(self):
        self.add_floor()
        self.light.data.color = (1, 0.5, 0.25)
        self.assert_agrees()
        self.light.data.type, self.light.data.energy, self.light.data.angle = "SUN", 3, 0.2
        self.assert_agrees()
        self.light.data.type, self.light.data.energy = "AREA", 1000
        self.light.data.shape, self.light.data.size, self.light.data.size_y = "RECTANGLE", 2, 0.5
        self.light.rotation_euler, self.light.scale = (0.6, 0, 0.8), (1, 2, 1)
        self.assert_agrees()

    def test_spots(self):
        """Cycles also multiplies the light of a spot by the cosine of the angle from its axis."""
        self.add_floor()
        self.light.data.type, self.light.data.spot_size, self.light.data.spot_blend = "SPOT", 0.3, 0.2
        self.light.data.shadow_soft_size = 0
        self.light.rotation_euler = (0.6, 0.2, 0.8)
        self.assert_agrees(1 - math.cos(0.15) + 0.03)
        self.assertIn("Cycles multiplies by the cosine", self.notes())

    def test_worlds(self):
        """An image that a Mapping node turns. Colours are in the test of surfaces."""
        bpy.ops.mesh.primitive_uv_sphere_add(radius=2)
        bpy.ops.object.shade_smooth()
        dress(bpy.context.object, shader("ShaderNodeBsdfDiffuse"))
        self.background["Strength"].default_value = 0.7
        image = bpy.data.images.new("sky", 64, 32, float_buffer=True)
        pixels = np.ones((32, 64, 4), dtype=np.float32)
        rows, columns = np.mgrid[0:32, 0:64]
        pixels[..., 0], pixels[..., 1], pixels[..., 2] = columns / 63, rows / 31, columns % 16 < 8
        pixels[20:28, 4:12, :3] = 5
        image.pixels.foreach_set(pixels.reshape(-1))
        tree = self.scene.world.node_tree
        texture, mapping, coordinates = (tree.nodes.new(f"ShaderNode{n}") for n in ("TexEnvironment", "Mapping", "TexCoord"))
        texture.image = image
        mapping.inputs["Rotation"].default_value = (0, 0, math.radians(50))
        tree.links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
        tree.links.new(texture.outputs["Color"], self.background["Color"])
        self.assert_agrees()

    def test_surfaces(self):
        """Metals and coats differ at grazing angles: Cycles' diffuse base is not darkened by the coat's reflection."""
        self.background["Strength"].default_value, self.background["Color"].default_value = 0.8, (1, 0.9, 0.8, 1)
        self.light.data.energy = 0
        bpy.ops.mesh.primitive_uv_sphere_add(radius=2)
        bpy.ops.object.shade_smooth()
        ball = bpy.context.object
        for material, tolerance in (
            (shader("ShaderNodeBsdfDiffuse", Color=(0.8, 0.4, 0.1)), 0.02),
            (principled("Plastic", Base_Color=(0.8, 0.4, 0.1), Roughness=0.4), 0.03),
            (principled("Metal", Base_Color=(0.8, 0.4, 0.1), Roughness=0.3, Metallic=1.0), 0.03),
        ):
            with self.subTest(material.name):
                dress(ball, material)
                self.assert_agrees(tolerance)

    def add_ball(self):
        """A ball that fills the picture, in the light of a sun that is 30° wide."""
        self.scene.camera.data.lens = 130
        self.background["Color"].default_value, self.background["Strength"].default_value = (1, 1, 1, 1), 0.02
        self.light.data.type, self.light.data.energy, self.light.data.angle = "SUN", 3, 0.5
        self.light.rotation_euler = (0.6, 0.2, 0.8)
        self.scene.phasetree.samples = self.scene.cycles.samples = 48
        bpy.ops.mesh.primitive_uv_sphere_add(radius=2)
        bpy.ops.object.shade_smooth()
        return bpy.context.object

    def test_layers(self):
        """Coat and sheen of dark balls, and the highlights of a faint lamp, under a white sky."""
        ball, dark = self.add_ball(), {"Base_Color": (0.1, 0.1, 0.1)}
        self.background["Strength"].default_value, self.light.data.energy = 0.8, 0
        self.scene.phasetree.samples = self.scene.cycles.samples = 16
        for material in (
            principled("Car", Roughness=0.4, Specular=0.0, Clearcoat=1.0, Clearcoat_Roughness=0.2, **dark),
            principled("Cloth", Specular=0.0, Sheen=1.0, **dark),
            principled("Lamp", Roughness=0.2, Emission=(0.02, 0.02, 0.02), **dark),
        ):
            with self.subTest(material.name):
                dress(ball, material)
                self.assert_agrees(0.03)

    def test_anisotropy(self):
        """The grain runs around the z axis of the ball, turned by 45°."""
        brushed = principled("Brushed", Metallic=1.0, Roughness=0.25, Anisotropic=0.9, Anisotropic_Rotation=0.125)
        brushed.node_tree.nodes["Principled BSDF"].distribution = "MULTI_GGX"
        dress(self.add_ball(), brushed)
        self.assert_agrees(0.03)
        self.assertEqual(self.notes(), "")

    def test_images_of_metallic_and_roughness(self):
        """Two grey images of different sizes, of which one is sRGB; then two channels of one image, which a Mapping turns.

        The sky is not dark: where only the sun lights the ball, the two differ by up to 17 %, for a reason that is not known.
        """
        material = principled("Rust", Base_Color=(0.8, 0.4, 0.1))
        tree = material.node_tree
        bsdf, (first, second, mapping, parts) = tree.nodes["Principled BSDF"], (
            tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexImage", "TexImage", "Mapping", "SeparateColor"))  # fmt: skip
        rows, columns = np.mgrid[0:32, 0:64]
        first.image = image_of(0.1 + 0.3 * (columns < 30), True)
        second.image = image_of((rows[::2, ::2] < 20) * 1.0, False)
        tree.links.new(first.outputs["Color"], bsdf.inputs["Roughness"])
        tree.links.new(second.outputs["Color"], bsdf.inputs["Metallic"])
        dress(self.add_ball(), material)
        self.scene.phasetree.samples = self.scene.cycles.samples = 400
        self.scene.camera.data.lens, self.background["Strength"].default_value = 50, 0.1
        self.assert_agrees(0.03)
        self.assertEqual(self.notes(), "")
        first.image = image_of(np.stack([0 * rows, 0.1 + 0.3 * (columns < 30), rows < 20], axis=2), True)
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["UV"], mapping.inputs["Vector"])
        mapping.inputs["Scale"].default_value, mapping.inputs["Rotation"].default_value = (2, 1, 1), (0, 0, 1.2)
        tree.links.new(mapping.outputs["Vector"], first.inputs["Vector"])
        tree.links.new(first.outputs["Color"], parts.inputs["Color"])
        tree.links.new(parts.outputs["Green"], bsdf.inputs["Roughness"])
        tree.links.new(parts.outputs["Blue"], bsdf.inputs["Metallic"])
        self.assert_agrees(0.03)
        self.assertEqual(self.notes(), "")

    def test_mapping(self):
        """A plane fills the picture with a part of a colour image, moved, turned and scaled."""
        self.background["Color"].default_value, self.background["Strength"].default_value = (1, 1, 1, 1), 1
        self.light.data.energy = 0
        self.scene.camera.location, self.scene.camera.rotation_euler = (0, 0, 5), (0, 0, 0)
        bpy.ops.mesh.primitive_plane_add(size=4)
        material = shader("ShaderNodeBsdfDiffuse")
        tree = material.node_tree
        texture, mapping = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeMapping")
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["UV"], mapping.inputs["Vector"])
        rows, columns = np.mgrid[0:32, 0:32]
        texture.image = image_of(np.stack([columns > 8, rows > 20, (rows - columns) % 32 < 12], axis=2), True)
        tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
        tree.links.new(texture.outputs["Color"], tree.nodes["Diffuse BSDF"].inputs["Color"])
        dress(bpy.context.object, material)
        inputs = mapping.inputs
        inputs["Rotation"].default_value = (0, 0, 0.6)
        inputs["Location"].default_value = (0.3, 0.15, 0)
        for kind, scale in (("POINT", (0.7, -0.4, 1)), ("TEXTURE", (1.6, 1.6, 1))):
            with self.subTest(kind):
                mapping.vector_type = kind
                inputs["Scale"].default_value = scale
                self.assert_agrees()
                self.assertEqual(self.notes(), "")

    def test_depth_of_field(self):
        self.add_floor()
        bpy.ops.mesh.primitive_cube_add(size=1.5, location=(0, 0, 1))
        dress(bpy.context.object, shader("ShaderNodeEmission", Strength=2.0))
        lens = self.scene.camera.data.dof
        lens.use_dof, lens.focus_distance, lens.aperture_fstop = True, 4, 0.05
        self.assert_agrees(0.03)


if __name__ == "__main__":
    unittest.main()
