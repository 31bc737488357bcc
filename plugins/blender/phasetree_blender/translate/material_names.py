"""Names of materials in the scene file, and what they stand for in Blender, for Cryptomatte."""


class MaterialNames:
    """With `by_object`, each object has materials of its own, so that mattes can tell objects apart."""

    def __init__(self, by_object):
        self._by_object = by_object
        self.meanings = {}  # name of a material or phase: names of the object and of the material in Blender

    def of(self, object_name, material):
        """The name of an object's material."""
        own = material.name if material else "Default"
        name = f"{object_name}: {own}" if self._by_object else own
        self.meanings[name] = (object_name, own)
        return name

    def add(self, name, object_name, material_name):
        """Adds a phase that is named in another way."""
        self.meanings[name] = (object_name, material_name)

    def add_group(self, group):
        """Adds the phases of a scene file that is an object: they are named after it."""
        self.meanings.update({f"{group}.{name}": meaning for name, meaning in self.meanings.items()})
