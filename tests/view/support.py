"""A live view that runs, and a client for it, which can also be rude."""

import contextlib
import http.client
import json
import os
import pathlib
import re
import select
import signal
import socket
import subprocess
import tempfile
import time
import unittest

COMMAND = os.environ["PHASETREE_COMMAND"]
# How many times as long as usual the command may take: a sanitizer slows it down.
PATIENCE = float(os.environ.get("PHASETREE_PATIENCE", "1"))

SCENE = """{"version": 1,
"phases": {"glass": {"clear": {"ior": 1.5}}, "wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}}},
"shapes": {"ball": {"sphere": {"radius": 0.5}}},
"tree": {"under": [{"set": {"phase": "wood", "of": {"translate": {"by": [0.6, 0, 0], "of": "ball"}}}},
                   {"set": {"phase": "glass", "of": {"translate": {"by": [-0.6, 0, 0], "of": "ball"}}}}]},
"lights": [{"gradient": {"zenith": [1, 1, 1], "horizon": [0.5, 0.5, 0.5], "ground": [0.1, 0.1, 0.1]}}],
"camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 30},
"render": {"width": 96, "height": 64, "samples": 4}}
"""


def changed(text, old, new):
    assert old in text
    return text.replace(old, new)


class Answer:
    def __init__(self, status, body, headers):
        self.status, self.body, self.headers = status, body, headers

    @property
    def state(self):
        return json.loads(self.body.split(b"\n", 1)[0])

    @property
    def pixels(self):
        return self.body.split(b"\n", 1)[1]


class View:
    """`phasetree view` of a scene's text in a folder of its own."""

    name = "scene.json"

    def __init__(self, text=SCENE, *options):
        self.folder = tempfile.TemporaryDirectory()
        self.file = pathlib.Path(self.folder.name) / self.name
        self.file.write_text(text, encoding="utf-8")
        self.prepare()
        self.errors = open(pathlib.Path(self.folder.name) / "errors", "w+", encoding="utf-8")  # noqa: SIM115
        self.process = subprocess.Popen([COMMAND, "view", str(self.file), *options], stdout=subprocess.PIPE,
                                        stderr=self.errors, text=True, preexec_fn=self._hear_signals)
        self.url = ""
        if select.select([self.process.stdout], [], [], 60)[0]:
            self.url = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/", self.url)
        if not found:
            self.process.kill()
            raise AssertionError(f"no address: {self.url!r} {self.said()}")
        self.port, self.token = int(found[1]), found[2]

    def prepare(self):
        """Puts into the folder what the scene needs beside it."""

    @staticmethod
    def _hear_signals():
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.errors.close()
        self.folder.cleanup()

    def said(self):
        """What it has written to standard error."""
        return pathlib.Path(self.errors.name).read_text(encoding="utf-8")

    def end(self, with_signal=signal.SIGINT, within=20):
        """Its exit code."""
        self.process.send_signal(with_signal)
        return self.process.wait(timeout=within)

    def request(self, method, path, body=None, headers=None, timeout=30):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        with contextlib.closing(connection):
            # A server may answer before it has read all of an oversized body.
            with contextlib.suppress(BrokenPipeError, ConnectionResetError):
                connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return Answer(answer.status, answer.read(), answer.headers)

    def get(self, name, **more):
        return self.request("GET", f"/{self.token}/{name}", **more)

    def post(self, name, value, **more):
        body = value if isinstance(value, (str, bytes)) else json.dumps(value)
        return self.request("POST", f"/{self.token}/{name}", body, {"Content-Type": "application/json"}, **more)

    def wait_for(self, condition, within=60):
        """The first answer whose state the condition holds for."""
        version, end = 0, time.monotonic() + within * PATIENCE
        while time.monotonic() < end:
            answer = self.get(f"picture?after={version}")
            if condition(answer.state):
                return answer
            version = answer.state["version"]
        raise AssertionError(f"it does not come: {answer.state} {self.said()}")

    def ready(self):
        return self.wait_for(is_ready)

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=30)


def rendered(view, text, name="scene.png"):
    """The file that `render` makes of a text beside the view's scene."""
    with tempfile.TemporaryDirectory() as folder:
        file, out = pathlib.Path(folder) / view.file.name, pathlib.Path(folder) / name
        file.write_text(text, encoding="utf-8")
        subprocess.run([COMMAND, "render", str(file), "-o", str(out), "--quiet"], check=True)
        return out.read_bytes()


def is_ready(state):
    return state["doing"] == "Ready"


def skip(why):
    """CTest takes this line for a test that was left out."""
    print(f"SKIPPED: {why}")
    raise unittest.SkipTest(why)
