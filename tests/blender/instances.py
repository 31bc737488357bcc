"""Many instances: the scene stays small, and translating it takes bounded time and memory."""

import resource
import time
import unittest

import bpy
import numpy as np
from support import BlenderTest, dress, principled

MANY = 100_000


class Instances(BlenderTest):
    def add_instances(self, item, x, y):
        """Instances of an object on the vertices of a grid, whose points are 3 apart along x."""
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=x - 1, y_subdivisions=y - 1, size=3 * (x - 1))
        carrier = bpy.context.object
        carrier.scale.y = (y - 1) / (x - 1)
        self.assertEqual(len(carrier.data.vertices), x * y)
        carrier.instance_type = "VERTS"
        carrier.show_instancer_for_render = carrier.show_instancer_for_viewport = False
        item.parent = carrier
        bpy.context.view_layer.update()
        self.set_up_camera()

    def set_up_camera(self):
        camera = self.scene.camera
        camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", 12, 10000
        camera.location, camera.rotation_euler = (1.5, 1.5, 10), (0, 0, 0)
        self.scene.phasetree.samples = 1

    def measured(self, name):
        """The exported scene, and its time in seconds and memory in MB."""
        before, started = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
        scene = self.export()[1]
        spent = time.process_time() - started
        memory = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
        print(f"{name}: translated in {spent:.1f} s of processor time, {memory:.0f} MB more")
        self.assertLess(spent, 60)
        self.assertLess(memory, 1500)
        return scene

    def test_many_clear_instances_are_one_object(self):
        cube = dress(bpy.data.objects["Cube"], principled("Ice", 1, IOR=1.31, Roughness=0.0, Base_Color=(1.0, 1.0, 1.0)))
        self.add_instances(cube, 400, 250)
        scene = self.measured("clear")
        self.assertEqual(len(scene["objects"]), 1)
        self.assertEqual([instance["of"] for instance in scene["instances"]], ["Cube"])
        places = (self.folder / scene["instances"][0]["file"]).read_bytes()
        self.assertEqual(len(places), 16 + 48 * MANY)
        self.assertIn("its 100000 copies are instances of one object", self.notes())
        alpha = self.alpha()
        self.assertTrue(0.2 < alpha.mean() < 0.9, alpha.mean())

    def test_many_opaque_instances(self):
        self.add_instances(dress(bpy.data.objects["Cube"], principled("Paint")), 400, 250)
        scene = self.measured("opaque")
        self.assertEqual(len(scene["meshes"]), 1)
        alpha = self.alpha()
        self.assertTrue(0.2 < alpha.mean() < 0.9, alpha.mean())

    def test_too_many_triangles_become_solids(self):
        bpy.data.objects.remove(bpy.data.objects["Cube"])
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
        ball = dress(bpy.context.object, principled("Paint"))
        ball.name = "Ball"
        count = 250 * 200
        self.assertGreater(count * len(ball.data.polygons), 20_000_000)  # which the reader of glTF files rejects
        self.add_instances(ball, 250, 200)
        scene = self.measured("balls")
        self.assertNotIn("meshes", scene)
        self.assertEqual(list(scene["phases"]), ["Ball"])
        self.assertIn("principled", scene["phases"]["Ball"])
        self.assertEqual(self.notes(), "")
        self.assertGreater(self.alpha().mean(), 0.2)

    def alpha(self):
        self.scene.render.film_transparent = True
        started = time.monotonic()
        alpha = self.render()["ViewLayer.Combined.A"]
        print(f"rendered in {time.monotonic() - started:.1f} s; {self.children():.0f} MB")
        self.assertTrue(np.isfinite(alpha).all())
        self.assertLess(self.children(), 4000)
        return alpha

    @staticmethod
    def children():
        """The greatest memory of a child process, in MB."""
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024


if __name__ == "__main__":
    unittest.main()
