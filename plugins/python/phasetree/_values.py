"""Values that are immutable: a copy is the value itself, and a pickle is the call that makes an equal one."""


class Value:
    """A base class for immutable values. What is built on demand, such as an object's cells, is not pickled."""

    __slots__ = ()

    def _pickled(self):
        """The arguments from which _unpickled makes an equal value."""
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
