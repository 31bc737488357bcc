"""Exceptions for invalid trees, scenes and calls, with the C++ library's messages."""

from phasetree._phasetree import Error, SceneError

__all__ = ["Error", "SceneError"]
Error.__module__ = SceneError.__module__ = "phasetree"
