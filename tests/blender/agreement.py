"""Lights, cameras and surfaces are as bright as in Cycles, whose units are Blender's."""

import math
import unittest

import bpy
import numpy as np
from support import BlenderTest, dress, principled, shader


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

    def test_depth_of_field(self):
        self.add_floor()
        bpy.ops.mesh.primitive_cube_add(size=1.5, location=(0, 0, 1))
        dress(bpy.context.object, shader("ShaderNodeEmission", Strength=2.0))
        lens = self.scene.camera.data.dof
        lens.use_dof, lens.focus_distance, lens.aperture_fstop = True, 4, 0.05
        self.assert_agrees(0.03)


if __name__ == "__main__":
    unittest.main()
