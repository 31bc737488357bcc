"""What _trees defines and the modules below it use: formulas and phases make fields and objects.

_trees fills both dictionaries when the package is imported, so that modules only import what is below them.
"""

#: The function for each kind of node, by its name: functions["sphere"](1).
functions = {}

#: The classes "Field" and "Object".
classes = {}
