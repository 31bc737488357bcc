"""Translates a Blender scene into a phasetree scene file and the files that it names."""
