"""What a translated scene loses or approximates, for the panels and the console."""

from dataclasses import dataclass
from enum import Enum


class Kind(Enum):
    ERROR = "error"
    UNSUPPORTED = "not supported"
    APPROXIMATE = "approximate"
    INFORMATION = "information"


@dataclass(frozen=True)
class Note:
    kind: Kind
    subject: str  # what it is about, such as 'material "Glass"'; empty for the whole scene
    text: str

    def __str__(self):
        return f"{self.kind.value}: {self.subject + ': ' if self.subject else ''}{self.text}"


class Notes:
    """A list of notes without duplicates, in the order in which they were added."""

    def __init__(self, subject=""):
        self.subject = subject
        self._notes = {}

    def __iter__(self):
        return iter(self._notes)

    def __len__(self):
        return len(self._notes)

    def about(self, subject):
        """A view of the same list whose notes are about the subject."""
        other = Notes(subject)
        other._notes = self._notes
        return other

    def add(self, kind, text):
        self._notes[Note(kind, self.subject, text)] = True

    def unsupported(self, text):
        self.add(Kind.UNSUPPORTED, text)

    def approximate(self, text):
        self.add(Kind.APPROXIMATE, text)

    def information(self, text):
        self.add(Kind.INFORMATION, text)

    def error(self, text):
        self.add(Kind.ERROR, text)

    def of_kind(self, kind):
        return [note for note in self if note.kind is kind]


class TranslationError(Exception):
    """The scene cannot be rendered. The message says what is wrong and how to fix it."""
