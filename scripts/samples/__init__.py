"""The sample characters of data/: control cages, rigs, paint and clips, written through Blender."""
