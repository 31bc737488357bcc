"""The live view's server: whom it refuses, that it outlives what it is sent, and how it ends."""

import pathlib
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import COMMAND, SCENE, View, is_ready  # noqa: E402


class Refusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.view = View().__enter__()
        cls.view.ready()

    @classmethod
    def tearDownClass(cls):
        code = cls.view.end(signal.SIGTERM)
        cls.view.__exit__()
        assert code == 0, code

    def tearDown(self):
        # After any request, the server still answers.
        self.assertEqual(self.view.get("").status, 200)
        self.assertEqual(self.view.get("picture").status, 200)

    def test_only_the_token_opens(self):
        view = self.view
        for path in ("/", "/picture", f"/{'0' * 32}/", f"/{view.token[:-1]}/", f"/{view.token}", f"//{view.token}/",
                     f"/{view.token}0/picture", "/../../etc/passwd"):
            self.assertEqual(view.request("GET", path).status, 403, path)
        self.assertEqual(view.request("POST", "/change", "{}", {"Content-Type": "application/json"}).status, 403)
        self.assertEqual(view.get("../../etc/passwd").status, 404)
        self.assertEqual(view.request("PUT", f"/{view.token}/change", "{}").status, 405)

    def test_only_its_own_host_and_origin(self):
        view = self.view
        own = f"127.0.0.1:{view.port}"
        for host in ("evil.example", f"evil.example:{view.port}", "127.0.0.1", f"127.0.0.1:{view.port}.evil.example", ""):
            self.assertEqual(view.get("", headers={"Host": host}).status, 403, host)
        for origin in ("http://evil.example", "null", f"https://{own}", f"http://{own}.evil.example"):
            for method in ("GET", "POST"):
                answer = view.request(method, f"/{view.token}/change", "{}", {"Host": own, "Origin": origin})
                self.assertEqual(answer.status, 403, origin)
        self.assertEqual(view.get("", headers={"Host": own, "Origin": f"http://{own}"}).status, 200)
        self.assertEqual(view.get("", headers={"Host": f"localhost:{view.port}"}).status, 200)

    def test_nobody_may_frame_it_or_learn_its_address(self):
        headers = self.view.get("").headers
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])
        self.assertEqual(headers["Referrer-Policy"], "no-referrer")

    def test_it_listens_on_the_loopback_address_alone(self):
        listening = []
        for table in ("/proc/net/tcp", "/proc/net/tcp6"):
            for line in pathlib.Path(table).read_text(encoding="ascii").splitlines()[1:]:
                address, port = line.split()[1].split(":")
                if line.split()[3] == "0A" and int(port, 16) == self.view.port:
                    listening.append(address)
        self.assertEqual(listening, ["0100007F"])

    def test_wrong_changes_are_refused_and_told(self):
        view = self.view
        before = view.get("picture").state["version"]
        for wish in ("", "{", "[]", "{}x", "1e999", '{"camera": 5}', '{"camera": {"position": [0, 0, 0]}}', '{"exposure": 99}',
                     '{"camera": {"position": [0, 0, 0], "look_at": [0, 0, 0]}}', '{"hidden": "glass"}', '{"hiden": []}',
                     '{"looks": []}', '{"looks": {"wood": 1}}', '{"looks": {"wood": {"ior": 0}}}', '{"looks": {"wood": {"color": "brown"}}}',
                     '{"looks": {"wood": {"roughness": 2}}}', '{"looks": {"wood": {"clear": 1}}}', '{"cut": {"normal": [0, 0, 1]}}',
                     '{"cut": {"normal": [0, 0, 0], "offset": 1}}', '{"cut": {"normal": [0, 0, 1], "offset": 1e30}}',
                     "[" * 60000, b'{"hidden": ["\xff"]}'):
            answer = view.post("change", wish)
            self.assertEqual(answer.status, 400, wish[:60])
        self.assertIn(b'did you mean "hidden"', view.post("change", '{"hiden": []}').body)
        for place in ("{}", '{"x": -1, "y": 0}', '{"x": 1e9, "y": 0}', '{"x": 1, "y": 1, "z": 1}'):
            self.assertEqual(view.post("ask", place).status, 400, place)
        self.assertEqual(view.get("picture").state["version"], before)

    def test_large_and_strange_bodies_are_refused(self):
        view = self.view
        path = f"/{view.token}/change"
        kind = {"Content-Type": "application/json"}
        self.assertEqual(view.post("change", " " * 65537).status, 413)
        self.assertEqual(view.request("POST", path, "{}", {"Content-Type": "text/plain"}).status, 415)
        self.assertEqual(view.request("POST", path, "{}", {**kind, "Content-Encoding": "gzip"}).status, 411)
        self.assertEqual(view.request("POST", path, iter([b"{}"]), {**kind, "Transfer-Encoding": "chunked"}).status, 411)

    def answer_to(self, *parts, pause=0.0):
        with self.view.connect() as connection:
            try:
                for part in parts:
                    connection.sendall(part)
                    time.sleep(pause)
                return connection.recv(100)
            except (BrokenPipeError, ConnectionResetError):
                return b""

    def test_heads_are_limited(self):
        head = f"GET /{self.view.token}/ HTTP/1.1\r\nHost: 127.0.0.1:{self.view.port}\r\n".encode()
        for line in (b"X: " + b"x" * 20000 + b"\r\n\r\n", b"X: y\r\n" * 5000 + b"\r\n", b"\0" * 20000):
            self.assertNotIn(b"200 OK", self.answer_to(head + line))
        self.assertNotIn(b"200 OK", self.answer_to(b"GET /" + b"a" * 15000 + b" HTTP/1.1\r\n\r\n"))
        # A thousand times the picture, or a pattern that is matched by recursion.
        ranges = b"Range: bytes=" + b",".join([b"0-"] * 2000) + b"\r\n\r\n"
        self.assertIn(b"200 OK", self.answer_to(head + ranges))

    def test_nothing_is_compressed(self):
        # Compressing the catalogue would take more than a second.
        for name in ("catalogue", "document", "", "style.css"):
            headers = self.view.get(name, headers={"Accept-Encoding": "gzip, deflate, br"}).headers
            self.assertNotIn("Content-Encoding", headers)
            self.assertIn("Content-Length", headers)

    def test_half_requests_run_out_of_time(self):
        begun = f"POST /{self.view.token}/change HTTP/1.1\r\nHost: 127.0.0.1:{self.view.port}\r\n".encode()
        body = begun + b"Content-Type: application/json\r\nContent-Length: 100\r\n\r\n{"
        for half in (b"", b"GET", begun, body):
            with self.view.connect() as connection:
                connection.sendall(half)
                start = time.monotonic()
                while connection.recv(100):
                    pass
                self.assertLess(time.monotonic() - start, 15)

    def test_a_request_that_drips_runs_out_of_time(self):
        start = time.monotonic()
        with self.view.connect() as connection:
            try:
                while time.monotonic() - start < 20:
                    connection.sendall(b"X")
                    time.sleep(0.05)
            except (BrokenPipeError, ConnectionResetError):
                pass
        self.assertLess(time.monotonic() - start, 15)

    def test_floods_are_refused(self):
        threads = pathlib.Path(f"/proc/{self.view.process.pid}/task")
        before = len(list(threads.iterdir()))
        flood = [self.view.connect() for _ in range(300)]
        try:
            time.sleep(0.5)
            self.assertLessEqual(len(list(threads.iterdir())), before + 2)
        finally:
            for connection in flood:
                connection.close()


class Ends(unittest.TestCase):
    def test_a_signal_ends_it_as_soon_as_the_address_is_there(self):
        # The thread that listens may not have begun to.
        for _ in range(20):
            with View() as view:
                self.assertEqual(view.end(signal.SIGTERM), 0)

    def test_it_ends_while_requests_are_open(self):
        with View() as view:
            state = view.ready().state
            waiting = view.connect()
            waiting.sendall(f"GET /{view.token}/picture?after={state['version']} HTTP/1.1\r\n"
                            f"Host: 127.0.0.1:{view.port}\r\n\r\n".encode())
            half = view.connect()
            half.sendall(b"GET /")
            start = time.monotonic()
            self.assertEqual(view.end(signal.SIGTERM), 0)
            self.assertLess(time.monotonic() - start, 10)
            waiting.close()
            half.close()

    def test_a_scene_that_is_wrong_from_the_start_is_said_and_can_be_repaired(self):
        with View(SCENE.replace("wood", "wod", 1)) as view:
            self.assertIn("scene.json:4:", view.wait_for(lambda s: s["error"]).state["error"])
            self.assertIn("scene.json:4:", view.said())
            view.file.write_text(SCENE, encoding="utf-8")
            view.wait_for(lambda s: is_ready(s) and not s["error"])

    def test_a_scene_that_is_in_no_file(self):
        run = subprocess.run([COMMAND, "view", "-"], input=SCENE, capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        run = subprocess.run([COMMAND, "view", "/nowhere/scene.json"], capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn("/nowhere/scene.json: ", run.stderr)

    def test_a_port_that_is_taken(self):
        with View() as view:
            run = subprocess.run([COMMAND, "view", str(view.file), "--port", str(view.port)], capture_output=True, text=True,
                                 check=False, timeout=60)
            self.assertEqual((run.returncode, run.stdout), (1, ""))
            self.assertIn(str(view.port), run.stderr)


if __name__ == "__main__":
    unittest.main()
