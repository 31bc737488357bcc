"""Paths of files, as the extension module takes them."""

import os

from phasetree._errors import Error


def path_text(path):
    """A path as text. Raises Error for a null character, at which C++ and the system would truncate the path."""
    text = os.fsdecode(path)
    if "\0" in text:
        raise Error(f"a path must not contain null characters, but is {text!r}")
    return text
