"""Exceptions for invalid trees, scenes and calls, with the C++ library's messages, and for interrupted calls."""

from phasetree._phasetree import Error, SceneError

__all__ = ["Error", "Interrupted", "SceneError"]
Error.__module__ = SceneError.__module__ = "phasetree"


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during Object.measure, Object.prove or solve. `result` is what they return, as far as it is known."""

    __module__ = "phasetree"

    def __init__(self, result):
        super().__init__("interrupted; the attribute `result` of this exception has what was known by then")
        self.result = result


def interrupted(exception, make):
    """The exception to raise instead of a KeyboardInterrupt: an Interrupted with make(result), if there is a result."""
    result = getattr(exception, "result", None)
    result = None if result is None else make(result)
    return exception if result is None else Interrupted(result)
