"""Clear objects become phases, by the rules of `phasetree import`; roles and priorities change them."""

import math
import unittest

import bpy
from support import BlenderTest, add_box, dress, principled, shader

IN_WALL, IN_WATER, IN_ICE, IN_ICE_ABOVE, ABOVE = (0.85, 0, 0.5), (0.4, 0, 0.5), (0, 0, 0.9), (0, 0, 1.15), (0.4, 0, 1.2)


def clear(name, ior):
    return principled(name, 1, IOR=ior, Roughness=0.0, Base_Color=(1.0, 1.0, 1.0))


class Phases(BlenderTest):
    def setUp(self):
        super().setUp()
        bpy.data.objects.remove(bpy.data.objects["Cube"])

    def add_drink(self):
        """A cup with walls from 0.8 to 0.9, water that reaches into them, and ice half in the water."""
        self.glass, self.water = clear("Glass", 1.5), clear("Water", 1.33)
        self.ice = clear("Ice", 1.31)
        self.add_water()
        cup = add_box("Cup", (-0.9, -0.9, 0), (0.9, 0.9, 2), self.glass)
        bpy.ops.object.transform_apply(location=True, scale=True)
        hollow = add_box("Hollow", (-0.8, -0.8, 0.1), (0.8, 0.8, 3), self.glass)
        hollow.hide_render = hollow.hide_viewport = True
        cut = cup.modifiers.new("Boolean", "BOOLEAN")
        cut.operation, cut.object = "DIFFERENCE", hollow
        add_box("Cube 1", (-0.2, -0.2, 0.8), (0.2, 0.2, 1.2), self.ice)

    def add_water(self):
        add_box("Water", (-0.85, -0.85, 0.05), (0.85, 0.85, 1), self.water)

    def test_overlapping_drink_has_the_order_of_import(self):
        self.add_drink()
        path, scene = self.export()
        points = (IN_WALL, IN_WATER, IN_ICE, IN_ICE_ABOVE, ABOVE)
        self.assertEqual(self.labels(path, points), ["Glass", "Water", "Ice", "Ice", "vacuum"])
        self.assertEqual(scene["phases"]["Water"], {"clear": {"ior": 1.33}})
        # The same file, imported by hand.
        report = self.run_command("import", "exported.glb", "-o", "again.json")
        self.assertIn('"Water" and "Cup" overlap by up to', report)
        self.assertIn('"Cup" wins (solid over liquid)', report)
        notes, phases = self.check()
        self.assertEqual(phases, report)
        self.assertEqual(notes, "")
        again = str(self.folder / "again.json")
        self.assertEqual(self.labels(again, (IN_WALL, IN_ICE)), ["Glass", "Ice"])

    def test_roles_and_priorities(self):
        self.add_drink()
        water, cup = bpy.data.objects["Water"], bpy.data.objects["Cup"]
        cup.name = "Thing"
        water.phasetree.role = "SOLID"
        cup.phasetree.role = "LIQUID"
        self.assertEqual(self.labels(self.export()[0], (IN_WALL, IN_WATER)), ["Water", "Water"])
        cup.phasetree.priority = 1
        self.assertEqual(self.labels(self.export()[0], (IN_WALL, IN_WATER)), ["Glass", "Water"])
        cup.phasetree.priority, water.phasetree.role, cup.phasetree.role = 0, "LIQUID", "GAS"
        self.assertIn('"Thing" wins (gas over liquid)', self.check()[1])
        cup.phasetree.role = "OPAQUE"
        path, scene = self.export()
        self.assertEqual(set(scene["phases"]), {"Water", "Ice"})
        self.assertEqual(len(scene["meshes"]), 1)
        self.assertIn('information: material "Glass": is clear, but opaque on objects whose role is Opaque', self.check()[0])

    def test_gap_is_closed_unless_switched_off(self):
        self.add_drink()
        bpy.data.objects.remove(bpy.data.objects["Water"])
        add_box("Water", (-0.795, -0.795, 0.105), (0.795, 0.795, 1), self.water)
        near_wall = (0.7975, 0, 0.5)
        self.assertEqual(self.labels(self.export()[0], [near_wall]), ["Water"])
        self.scene.phasetree.closes_gaps = False
        self.assertEqual(self.labels(self.export()[0], [near_wall]), ["vacuum"])

    def test_absorption_is_that_of_the_volume(self):
        self.add_drink()
        tree = self.water.node_tree
        volume = tree.nodes.new("ShaderNodeVolumeAbsorption")
        volume.inputs["Color"].default_value, volume.inputs["Density"].default_value = (0.25, 0.5, 1, 1), 4
        tree.links.new(volume.outputs["Volume"], tree.nodes["Material Output"].inputs["Volume"])
        clear = self.export()[1]["phases"]["Water"]["clear"]
        for color, absorption in zip(clear["color"], (3, 2, 0)):  # density × (1 − colour)
            self.assertAlmostEqual(-math.log(color) / clear["color_distance"], absorption, 5)

    def test_glass_and_instances_share_a_phase(self):
        glass = shader("ShaderNodeBsdfGlass", IOR=1.6, Roughness=0.5)
        add_box("Gem", (0, 0, 0), (1, 1, 1), glass)
        copy = bpy.context.object.copy()
        copy.location.x += 3
        self.scene.collection.objects.link(copy)
        path, scene = self.export()
        self.assertEqual(list(scene["phases"].values()), [{"clear": {"ior": 1.6, "roughness": 0.25}}])
        self.assertEqual(self.labels(path, [(0.5, 0.5, 0.5), (3.5, 0.5, 0.5), (2, 0.5, 0.5)]),
                         ["ShaderNodeBsdfGlass", "ShaderNodeBsdfGlass", "vacuum"])  # fmt: skip

    def test_open_glass_is_reported(self):
        glass = clear("Glass", 1.5)
        bpy.ops.mesh.primitive_cylinder_add(end_fill_type="NOTHING", vertices=16)
        dress(bpy.context.object, glass).name = "Tube"
        notes, _ = self.check()
        self.assertIn('"Tube" is not closed: 32 edges', notes)
        bpy.ops.mesh.primitive_plane_add()
        dress(bpy.context.object, glass).name = "Pane"
        notes, _ = self.check()
        self.assertIn('"Pane"', notes)
        self.assertIn("it is left out", notes)
        self.render()  # the tube

    def test_reported_objects_are_selected(self):
        self.add_drink()
        self.assertFalse(bpy.ops.phasetree.select_reported.poll())
        bpy.ops.mesh.primitive_cylinder_add(end_fill_type="NOTHING", vertices=16, location=(5, 0, 0))
        dress(bpy.context.object, self.glass).name = 'Tube "1"'
        add_box("Apart", (8, 8, 8), (9, 9, 9), self.glass)
        self.check()
        bpy.ops.phasetree.select_reported()
        self.assertEqual({item.name for item in bpy.context.selected_objects}, {"Cup", "Water", "Cube 1", 'Tube "1"'})

    def test_facets_of_smooth_glass_are_reported(self):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
        dress(bpy.context.object, clear("Glass", 1.5)).name = "Ball"
        self.assertEqual(self.check()[0], "")
        bpy.ops.object.shade_smooth()
        self.assertRegex(self.check()[0], r'object "Ball": clear objects are shaded flat, so facets of up to 1\d° are visible')


if __name__ == "__main__":
    unittest.main()
