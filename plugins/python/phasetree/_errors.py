"""What is wrong with a tree, a scene or a call, in the words of the C++ library."""

from phasetree._phasetree import Error, SceneError

__all__ = ["Error", "SceneError"]
Error.__module__ = SceneError.__module__ = "phasetree"
