"""Immutable values: copying returns the value itself, and pickling stores the call that makes an equal one."""


class Value:
    """Base class of immutable values. Pickles do not contain what is built on demand, such as an object's cells."""

    __slots__ = ()

    def _pickled(self):
        """The arguments with which _unpickled makes an equal value."""
        raise NotImplementedError

    @classmethod
    def _unpickled(cls, *arguments):
        return cls(*arguments)

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self

    def __reduce__(self):
        return type(self)._unpickled, self._pickled()
