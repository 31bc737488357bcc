"""The server's memory while a scene is edited: memory for reading and building large scenes is returned to the system,
whichever of the server's threads used it."""

import json
import pathlib
import sys
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_random import kilobytes  # noqa: E402
from support import PATIENCE, View  # noqa: E402

# Copies of copies, which take about 100 MB and half a second to prepare.
COPIES = ('{"proxy": {"of": {"fibonacci_sphere": {"count": 50, "radius": 0.5, "of": {"fibonacci_disk": {"count": %d, "radius": 0.1, "of": {"sphere": '
          '{"radius": 0.01}}}}}}, "proxy": {"sphere": {"radius": 0.7}}, "error": 0.01, "margin": 0.1}}')
SCENE = """{"version": 1,
"phases": {"wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}}},
"tree": {"set": {"phase": "wood", "of": %s}},
"lights": [{"constant": {"radiance": [1, 1, 1]}}],
"camera": {"position": [0, -9, 0], "look_at": [0, 0, 0], "fov": 30},
"render": {"width": 32, "height": 24, "samples": 1}}
"""
BALL = '{"sphere": {"radius": 0.5}}'
EDITS, LARGE = 300, 36
OF = "/tree/set/of"


class Memory(unittest.TestCase):
    def edit(self, view, value, threads=1):
        """Sends the same edit in several simultaneous requests, so that several threads check it."""
        answers = []

        def send():
            answers.append(view.post("document", {"base": self.version(view), "label": "Edit", "strict": True,
                                                  "operations": [{"set": OF, "to": value}]}, timeout=60 * PATIENCE))
        senders = [threading.Thread(target=send) for _ in range(threads)]
        for sender in senders:
            sender.start()
        for sender in senders:
            sender.join()
        return [answer.status for answer in answers]

    def version(self, view):
        return json.loads(view.get("document?after=0").body)["version"]

    def test_what_large_scenes_take_is_given_back(self):
        with View(SCENE % BALL, "--threads", "1") as view:
            view.ready()
            for i in range(20):
                self.edit(view, BALL.replace("0.5", f"0.{i + 30}"))
            view.ready()
            before, most = kilobytes(view.process), 0
            for i in range(EDITS):
                if i % (EDITS // LARGE) == 0:
                    self.edit(view, COPIES % (200 + i), threads=4)
                    most = max(most, kilobytes(view.process))
                self.assertEqual(self.edit(view, BALL.replace("0.5", f"0.{i % 50 + 30}")), [200])
            view.ready()
            end = time.monotonic() + 20 * PATIENCE
            while kilobytes(view.process) - before > 72 * 1024 and time.monotonic() < end:
                time.sleep(0.2)
            grown = kilobytes(view.process) - before
            print(f"{before} KiB, at most {most} KiB; grown by {grown} KiB", file=sys.stderr)
            # If not, the scenes are too small for this test.
            self.assertGreater(most - before, 100 * 1024)
            self.assertLess(grown, 80 * 1024)


if __name__ == "__main__":
    unittest.main()
