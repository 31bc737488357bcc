"""Writes hourglasses.places: hourglasses in a sunflower's spiral, each turned about its axis and a little
smaller than the first. Run it in scenes/objects."""
import math
import random
import struct

COUNT, SPACING, STANDS_AT = 2400, 1.42, -1.2299  # the foot of an hourglass of size 1 is at z = STANDS_AT
random.seed(39)
with open("hourglasses.places", "wb") as file:
    file.write(b"PTPLACES" + struct.pack("<Q", COUNT))
    for i in range(COUNT):
        radius, turn = SPACING * math.sqrt(i + 0.5), i * math.pi * (3 - math.sqrt(5))
        size, about = random.uniform(0.72, 1.0), random.uniform(0, 2 * math.pi)
        c, s = size * math.cos(about), size * math.sin(about)
        place = (radius * math.cos(turn), radius * math.sin(turn), STANDS_AT * (1 - size))
        file.write(struct.pack("<12f", c, s, 0, -s, c, 0, 0, 0, size, *place))
