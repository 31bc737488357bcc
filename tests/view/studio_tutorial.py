"""Makes the pictures of the tutorial about the studio: the page in Chromium, in which a glass of water is built.

    PHASETREE_COMMAND=build/release/tracer/phasetree python3 tests/view/studio_tutorial.py tracer/manual/images

The pictures are taken when there is little noise, so they do not show how long that takes."""

import base64
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from browser import Browser  # noqa: E402
from studio_user import EMPTY, User, build_glass_of_water  # noqa: E402
from support import View  # noqa: E402

# Enough samples to see everything.
CLEAR = """(() => {
    const status = document.getElementById('status').textContent, samples = /^(\\d+) of/.exec(status);
    return status.startsWith('Ready') || (samples && Number(samples[1]) >= 4) || !document.getElementById('empty').hidden;
})()"""


class GlassView(View):
    name = "glass.json"


def main():
    folder = pathlib.Path(sys.argv[1])
    with GlassView(EMPTY) as view, Browser(1280, 720) as browser:
        user = User(browser)
        user.open(view.url)

        def take(name):
            time.sleep(2)  # the picture of the last change has begun
            user.until("[...document.images].every((image) => image.complete)")
            user.until(CLEAR, 300)
            data = browser.call("Page.captureScreenshot", format="jpeg", quality=72)["data"]
            (folder / f"studio-{name}.jpg").write_bytes(base64.b64decode(data))

        build_glass_of_water(user, take)
        print(view.file.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
