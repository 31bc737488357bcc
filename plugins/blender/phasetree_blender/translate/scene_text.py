"""Scene files as Python values: comments, the numbers in them, and the files that they name."""

import copy
import json
import os
import re

from ..notes import TranslationError

COMMENT_OR_TEXT = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def parsed(text, path):
    """The value of a scene file's text. Raises TranslationError."""

    def kept(found):
        word = found[0]
        return word if word.startswith('"') else re.sub(r"[^\n]", " ", word)

    try:
        return json.loads(COMMENT_OR_TEXT.sub(kept, text))
    except json.JSONDecodeError as error:
        raise TranslationError(f"{path}:{error.lineno}:{error.colno}: {error.msg}") from error


def read(path):
    """The value of a scene file. Raises TranslationError."""
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise TranslationError(f"cannot read {path}: {reason}") from error
    return parsed(text, path)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def numbers_in(value, pointer=""):
    """{JSON pointer: number} of all numbers below a value."""
    if is_number(value):
        return {pointer: value}
    members = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    found = {}
    for key, member in members:
        step = str(key).replace("~", "~0").replace("/", "~1")
        found.update(numbers_in(member, f"{pointer}/{step}"))
    return found


def numbers_of_trees(document):
    """{JSON pointer: number} of the numbers that shape the objects of a scene."""
    found = {}
    for part in ("shapes", "tree", "objects", "instances", "phases"):
        if part in document:
            found.update(numbers_in(document[part], f"/{part}"))
    return found


def with_number(document, pointer, number):
    """Sets the number at a JSON pointer. Returns whether there is one."""
    *steps, last = [step.replace("~1", "/").replace("~0", "~") for step in pointer.split("/")[1:]]
    owner = document
    for step in steps:
        owner = member_of(owner, step)
    if not is_number(member_of(owner, last)):
        return False
    owner[int(last) if isinstance(owner, list) else last] = int(number) if float(number).is_integer() else float(number)
    return True


def member_of(owner, step):
    if isinstance(owner, dict):
        return owner.get(step)
    if isinstance(owner, list) and step.isdigit() and int(step) < len(owner):
        return owner[int(step)]
    return None


def with_absolute_files(value, folder):
    """A copy in which files are named absolutely, so that the scene can be written to another folder."""
    if isinstance(value, list):
        return [with_absolute_files(v, folder) for v in value]
    if not isinstance(value, dict):
        return copy.copy(value)
    return {
        key: os.path.join(folder, v) if key == "file" and isinstance(v, str) else with_absolute_files(v, folder)
        for key, v in value.items()
        if key != "$schema"
    }
