"""What the last translation of each scene reported. Panels draw it; a render thread cannot store it in the file."""

import re
from dataclasses import dataclass, field


@dataclass
class Report:
    notes: list = field(default_factory=list)
    phases: str = ""  # the order of the phases, overlaps and gaps


_reports = {}


def keep(scene_name, notes, phases):
    _reports[scene_name] = Report(list(notes), phases)


def of(scene_name):
    return _reports.get(scene_name)


def forget(scene_name):
    _reports.pop(scene_name, None)


def object_names(report):
    """Names of the objects that overlap, have a gap between them, or are open."""
    pairs = re.findall(r'^"(.+)" and "(.+)" (?:overlap by|have a gap)', report.phases, re.MULTILINE)
    opened = [found[1] for note in report.notes if (found := re.match(r'"(.+)" is not closed', note.text))]
    return {name for pair in pairs for name in pair}.union(opened)


def clear():
    _reports.clear()
