"""What the last translation of each scene reported. Panels draw it; a render thread cannot store it in the file."""

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


def clear():
    _reports.clear()
