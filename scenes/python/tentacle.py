"""The paper's tentacle (Figure 1), after scenes/tentacle.json: python3 tentacle.py [IMAGE SAMPLES]"""
import sys
import numpy as np
import phasetree as pt

# The axis is a spiral in x and z, which comes towards the viewer as the arm grows thin. Points are denser there.
s = 10.45 * (1 - np.geomspace(1, 0.015, 194))
radius = 0.057 * (10.45 - s) + 0.18 * np.exp(-s)
angle = 1.72 + np.cumsum(np.gradient(s) * (0.6 * np.exp(-((s / 4.75) ** 2)) - 0.22 / radius))
x, z = (np.cumsum(np.gradient(s) * f(angle)) for f in (np.cos, np.sin))
axis = np.stack([x, -1.16 * np.exp(-((radius / 0.2245) ** 2)), z - 0.4], axis=1)


def around(length, turn):  # Point, radius and direction of the axis at an arc length, and a direction away from it.
    point, along = (np.array([np.interp(length, s, v) for v in a.T]) for a in (axis, np.gradient(axis, axis=0)))
    inward = np.cross((0, 1, 0), along := along / np.linalg.norm(along))
    inward /= np.linalg.norm(inward)
    return point, np.interp(length, s, radius), along, np.cos(turn) * inward + np.sin(turn) * np.cross(along, inward)


marble = pt.textures.marble((0.66, 0.16, 0.12), vein=(0.86, 0.5, 0.42), scale=0.22, seed=3)
grain = pt.textures.speckle((0.88, 0.66, 0.36), (0.93, 0.8, 0.56), grain=0.025, contrast=0.15)
spots = pt.textures.speckle((0.16, 0.022, 0.055), (0.36, 0.065, 0.085), grain=0.05, contrast=0.3)
flesh, fat = pt.phase("flesh", pt.coated(marble, roughness=0.22)), pt.phase("fat", pt.coated(grain, roughness=0.2))
skin, bumps = (pt.phase(n, pt.coated(c, roughness=0.12)) for n, c in (("skin", spots), ("bumps", (0.82, 0.4, 0.3))))

# The arm is a chain of cones, in layers: each embeds what is within and touches it exactly.
links = [pt.round_cone(*link) for link in zip(axis, radius, axis[1:], radius[1:])]
arm = flesh(pt.union(links)).layered_sequence([fat, skin], [0.085, 0.04])

# A sucker is a cup with a thick rim; they stand in two rows. Bumps lie on a spiral, each turned by the golden angle.
cup = pt.capped_cone(0.44, 0.36, 0.5).translate((0, 0, 0.1)).smooth(0.3) | pt.torus(0.4, 0.11).translate((0, 0, 0.36))
sucker, suckers, places, sizes = cup.smooth(0.16) - pt.sphere(0.37).translate((0, 0, 0.56)), [], [], []
for i, length in enumerate(10.45 * (1 - np.geomspace(0.97, 0.1, 62))):
    point, r, along, out = around(length, np.radians((-33 if i % 2 else 17) - 5.5 * length))
    size = 0.5 * r + 0.025
    frame = (size * np.cross(along, out), size * along, size * out, point + (r + 0.125 - 0.15 * size) * out)
    suckers.append(sucker.affine(*frame))
for i, length in enumerate(10.45 * (1 - np.geomspace(1, 0.016, 2300))):
    point, r, _, out = around(length, turn := i * np.pi * (3 - np.sqrt(5)))
    if np.cos(turn + 0.2 + 0.1 * length) < 0.5:
        places.append(point + (r + 0.118) * out)
        sizes.append((0.01 + 0.06 * r) * 2 ** np.sin(7 * i))
tentacle = bumps(pt.sphere(1).instances(places, scales=sizes), pt.union(suckers)).under(arm)

# Each phase is cut by its own shape, the skin farthest up the arm, so that each layer shows its outside and section.
for phases, y, height, tilt in (((skin, bumps), -0.86, 4.7, -18), (fat, -0.98, 3.5, -14), (flesh, -1.1, 2.1, -10)):
    knife = pt.rounded_box((4, 2, height), 0.03).rotate(tilt, axis=(0, 1, 0)).translate((-0.2, y, 0))
    tentacle = tentacle.subtract_shape(knife, phases=phases)

lamps = [pt.lights.rectangle(at, (0, 0, 3), width, 4, intensity=intensity, visible_to_camera=False) for at, width, intensity
         in (((-5, -6.5, 7), 4, 14), ((5.5, 3.5, 5.5), 3, 28), ((-5.5, 4, 4), 2.5, 16))]
sky = pt.lights.gradient((0.15, 0.19, 0.22), (0.08, 0.11, 0.125), (0.02, 0.02, 0.02))
paper = pt.meshes.backdrop(pt.coated((0.035, 0.085, 0.095), roughness=0.3), distance=9, radius=5, width=80)
camera, image = pt.camera((-0.6, -17, 4.1), look_at=(-0.85, 0, 2.93), fov=22.6), pt.image(512, 720, max_depth=4)
scene = pt.Scene(tentacle, camera, [*lamps, sky], paper, image=image, name="tentacle")
if __name__ == "__main__":
    name, samples = sys.argv[1:3] if len(sys.argv) > 2 else ("tentacle.png", 16)
    scene.render(samples=int(samples), progress=True).save(name)
