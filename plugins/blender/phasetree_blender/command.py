"""The command `phasetree`, run as a child process, so that nothing it does can end Blender."""

import contextlib
import ctypes
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass

from .notes import TranslationError

MISSING = (
    "the command `phasetree`, which does the rendering, was not found. Build it with `bash tracer/quickstart.sh` in the "
    "sources of phasetree, and set its path in Edit > Preferences > Add-ons > phasetree, or put it on PATH"
)


SECONDS_BETWEEN_KEPT_CHECKPOINTS, SECONDS_FOR_LAST_CHECKPOINT = 60, 60


def find(preferred=""):
    """The path of the command: the preferred one, $PHASETREE_COMMAND, or one on PATH. Raises TranslationError."""
    for candidate in (preferred, os.environ.get("PHASETREE_COMMAND", ""), "phasetree"):
        found = shutil.which(candidate) if candidate else None
        if found:
            return found
        if candidate == preferred and preferred:
            raise TranslationError(f"{preferred} is not a program; correct the file in the add-on's preferences")
    raise TranslationError(MISSING)


# Loaded before any fork: between fork and exec, a child of a process with threads must not import anything.
LIBC = ctypes.CDLL(None) if sys.platform == "linux" else None
PR_SET_PDEATHSIG = 1


def end_with_parent():
    """Asks Linux to kill this process when the thread that started it ends, so that no render outlives a killed Blender."""
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def child_options():
    """Arguments of Popen for children that open no console window on Windows, and do not outlive Blender on Linux. The
    thread that starts a child must wait for it."""
    if os.name == "nt":
        return {"creationflags": subprocess.CREATE_NO_WINDOW}
    return {"preexec_fn": end_with_parent} if LIBC else {}


@dataclass
class Imported:
    report: str  # the order of the phases, overlaps and gaps
    warnings: list


def import_glb(command, glb, scene, closes_gaps, cancelled=lambda: False):
    """Makes a scene file of a glTF file. Raises TranslationError."""
    arguments = [command, "import", glb, "-o", scene, "--force", *([] if closes_gaps else ["--keep-gaps"])]
    done = run(arguments, cancelled)
    if done.returncode != 0:
        raise TranslationError(message_of(done.stderr, glb))
    warnings = [line.removeprefix("warning: ") for line in done.stderr.splitlines() if line.startswith("warning: ")]
    return Imported(done.stdout, [line.removeprefix(f"{glb}: ") for line in warnings])


def message_of(stderr, path):
    """The error message of the command, without its program name and the name of a temporary file."""
    text = "\n".join(line for line in stderr.splitlines() if not re.match(r"[\w ]+: +\d+%", line)).strip()
    return re.sub(rf"^(phasetree: )?(cannot import )?({re.escape(path)}: )?", "", text) or "phasetree ended without a message"


class Cancelled(Exception):
    """The user cancelled."""


def run(arguments, cancelled, **options):
    """Runs a command to its end, or raises Cancelled. `options`: of Popen."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        try:
            options = {**options, **child_options()}
            child = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=out, stderr=err, **options)
        except OSError as error:
            raise TranslationError(f"cannot run {arguments[0]}: {error.strerror}") from error
        try:
            while True:
                try:
                    child.wait(0.1)
                    break
                except subprocess.TimeoutExpired:
                    if cancelled():
                        raise Cancelled from None
        finally:
            end(child)

        def text(file):
            file.seek(0)
            return file.read().decode(errors="replace")

        return subprocess.CompletedProcess(arguments, child.returncode, text(out), text(err))


def end(child):
    """Ends a child process that still runs, at once: all of its files are temporary."""
    if child.poll() is None:
        child.kill()
        child.wait()


class UnusableCheckpoint(TranslationError):
    """The checkpoint belongs to another scene, other settings or another build."""


class RenderProcess:
    """`phasetree render` of a scene file. Writes an EXR file and, while it runs, checkpoints."""

    def __init__(self, command, scene, folder, options, seconds_between_checkpoints, kept_checkpoint=""):
        """`kept_checkpoint`: a file from which the render goes on if it exists, and which stays when the render ends."""
        self._command, self.picture = command, os.path.join(folder, "picture.exr")
        self._checkpoint, self._preview = os.path.join(folder, "checkpoint"), os.path.join(folder, "preview.exr")
        self._lines, self._scene = [], scene
        self.stage, self.share = "preparing", 0.0
        arguments = [command, "render", scene, "-o", self.picture, *options]
        self._is_kept, self.resumes = bool(kept_checkpoint), os.path.isfile(kept_checkpoint)
        if self._is_kept:
            self._checkpoint = kept_checkpoint
            arguments += ["--resume", kept_checkpoint, "--or-start"]
            seconds_between_checkpoints = seconds_between_checkpoints or SECONDS_BETWEEN_KEPT_CHECKPOINTS
        else:
            with contextlib.suppress(FileNotFoundError):
                os.remove(self._checkpoint)  # of an earlier render in this folder
        self._age = os.stat(self._checkpoint).st_mtime_ns if self.resumes else None  # it may be of another scene
        if seconds_between_checkpoints > 0:
            arguments += ["--checkpoint", self._checkpoint, "--checkpoint-interval", f"{seconds_between_checkpoints:g}s"]
        try:
            self._child = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                           stderr=subprocess.PIPE, text=True, errors="replace", **child_options())  # fmt: skip
        except OSError as error:
            raise TranslationError(f"cannot run {command}: {error.strerror}") from error
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._child.stderr:
            match = re.match(r"([\w ]+): +(\d+)%", line)
            if match:
                self.stage = "rendering" if match[1] == "Progress" else match[1]
                self.share = int(match[2]) / 100
            elif line.strip():
                self._lines.append(line.rstrip())

    def wait(self, seconds):
        """Waits for up to that time; returns whether the process has ended."""
        try:
            self._child.wait(seconds)
            return True
        except subprocess.TimeoutExpired:
            return False

    def preview(self):
        """The path of an EXR file of the samples so far, or None if there are no more than at the last call."""
        try:
            age = os.stat(self._checkpoint).st_mtime_ns
        except OSError:
            return None
        if age == self._age:
            return None
        self._age = age
        arguments = [self._command, "merge", self._checkpoint, "--allow-gaps", "--quiet", "-o", self._preview]
        done = subprocess.run(arguments, stdin=subprocess.DEVNULL, capture_output=True, check=False, **child_options())
        return self._preview if done.returncode == 0 else None

    def finish(self):
        """Raises TranslationError unless the picture is complete. Returns warnings."""
        self._reader.join(5)
        if self._child.returncode != 0:
            code, text = self._child.returncode, message_of("\n".join(self._lines), self._scene)
            if self.resumes and code == 2 and self._checkpoint in text:
                raise UnusableCheckpoint(text)
            ended = f"phasetree was ended by signal {-code}" if code < 0 else f"phasetree failed with exit code {code}"
            raise TranslationError(f"{ended}: {text}" if self._lines else ended)
        return [line.removeprefix("warning: ").removeprefix(f"{self._scene}: ") for line in self._lines if "warning: " in line]

    def stop(self):
        """Ends the render. One with a kept checkpoint may first write it."""
        if self._is_kept and self._child.poll() is None:
            self._child.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._child.wait(SECONDS_FOR_LAST_CHECKPOINT)
        end(self._child)
        self._reader.join(5)
        self._child.stderr.close()
