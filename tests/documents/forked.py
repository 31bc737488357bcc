"""Runs the command, through test-command-server (server/main.cpp) if that is running: this saves 0.25 s per command."""

import contextlib
import os
import socket
import struct
import subprocess
import tempfile

COMMAND = os.environ["PHASETREE_COMMAND"]
# The environment variable that holds the path of a running server's socket.
SOCKET = "PHASETREE_COMMAND_SOCKET"


@contextlib.contextmanager
def server():
    """Runs a server for this process and its children, if the build has one."""
    program = os.environ.get("PHASETREE_COMMAND_SERVER", "")
    if not os.access(program, os.X_OK):
        yield
        return
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/socket"
        with subprocess.Popen([program, path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as running:
            if running.stdout.readline() != "ready\n":
                raise AssertionError(f"{program} does not start")
            os.environ[SOCKET] = path
            try:
                yield
            finally:
                del os.environ[SOCKET]
                running.stdin.close()


def exit_code(words: list[str], streams: tuple[int, int, int] = (0, 1, 2), cwd=None) -> int:
    """Runs the command with these arguments and standard streams, and returns its exit code."""
    path = os.environ.get(SOCKET)
    if not path:
        return subprocess.run([COMMAND, *words], stdin=streams[0], stdout=streams[1], stderr=streams[2], cwd=cwd).returncode
    arguments = [COMMAND, *map(str, words)]
    texts = [str(cwd or os.getcwd()), str(len(arguments)), *arguments, *(f"{name}={value}" for name, value in os.environ.items())]
    data = b"".join(os.fsencode(text) + b"\0" for text in texts)
    with socket.socket(socket.AF_UNIX) as client:
        client.connect(path)
        socket.send_fds(client, [struct.pack("=I", len(data))], list(streams))
        client.sendall(data)
        answer = client.recv(4, socket.MSG_WAITALL)
    if len(answer) != 4:
        raise AssertionError(f"the server ended while it ran {arguments}")
    return os.waitstatus_to_exitcode(struct.unpack("=i", answer)[0])


def run(words: list[str], given: str = "", cwd=None) -> subprocess.CompletedProcess:
    """Runs the command like subprocess.run(), with text as input and output."""
    with tempfile.TemporaryFile() as stdin, tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        stdin.write(given.encode())
        stdin.seek(0)
        code = exit_code(words, (stdin.fileno(), out.fileno(), err.fileno()), cwd)
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode())
        return subprocess.CompletedProcess(words, code, *texts)
