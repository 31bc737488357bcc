"""Makes the picture of the manual about dragging surfaces: the studio in Chromium, in which a bottle is grabbed and dragged.

    PHASETREE_COMMAND=build/release/tracer/phasetree python3 tests/view/studio_grab_picture.py tracer/manual/images/studio-grab.jpg
"""

import base64
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from browser import Browser  # noqa: E402
from studio_user import ALT, User  # noqa: E402
from support import View  # noqa: E402

SAMPLES = 64
BOTTLE = """{
  "version": 1,
  "phases": {"clay": {"diffuse": {"color": [0.70, 0.42, 0.28]}}},
  "tree": {"set": {"phase": "clay", "of": {"smooth_union": {"radius": 0.2, "of": [
    {"translate": {"by": [0, 0, 0.42], "of": {"sphere": {"radius": 0.42}}}},
    {"translate": {"by": [0, 0, 0.95], "of": {"rounded_cylinder": {"radius": 0.14, "height": 0.6, "edge": 0.03}}}}
  ]}}}},
  "meshes": [{"backdrop": {"distance": 4, "radius": 2.5, "material": {"diffuse": {"color": [0.62, 0.63, 0.65]}}}}],
  "lights": [
    {"gradient": {"zenith": [0.34, 0.38, 0.45], "horizon": [0.30, 0.31, 0.33], "ground": [0.2, 0.2, 0.2]}},
    {"rectangle": {"centre": [-3, -2.5, 4], "target": [0, 0, 0.4], "width": 2.5, "height": 2.5, "radiance": [1, 0.96, 0.9], "intensity": 12, "visible_to_camera": false}}
  ],
  "camera": {"position": [0.6, -4.6, 1.8], "look_at": [0, 0, 0.6], "fov": 26},
  "render": {"width": 480, "height": 360, "samples": 64}
}
"""


class BottleView(View):
    name = "bottle.json"


def main():
    with BottleView(BOTTLE) as view, Browser(1280, 720) as browser:
        user = User(browser)
        user.open(view.url)
        user.until("document.getElementById('picture').width > 1")
        user.click(user.row("Clay smooth union"))
        x, y = user.place("#picture")
        size = browser.run("document.getElementById('picture').getBoundingClientRect().height")
        # The right side of the body, which is dragged outwards.
        start = (x + 0.16 * size, y + 0.16 * size)
        browser.drag(start, (start[0] + 0.08 * size, start[1]), modifiers=ALT)
        user.until("studio.grab.point && !studio.grab.isBusy && !studio.scene.isBusy")
        time.sleep(1)
        user.until(f"/^(Ready|{SAMPLES} of)/.test(document.getElementById('status').textContent)", 1200)
        data = browser.call("Page.captureScreenshot", format="jpeg", quality=80)["data"]
        pathlib.Path(sys.argv[1]).write_bytes(base64.b64decode(data))
        print(view.file.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
