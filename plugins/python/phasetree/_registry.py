"""Functions and classes that _trees defines, and that lower modules use to make fields and objects.

_trees fills both dictionaries when the package is imported, so lower-level modules need not import _trees.
"""

#: The function of each kind of node, by name: functions["sphere"](1).
functions = {}

#: The classes Field and Object, by name.
classes = {}
