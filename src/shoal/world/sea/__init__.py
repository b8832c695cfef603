"""The water that carries agents and targets, the wind on them, and the land that stops them: kernels on prepared grids.

Who reads files and prepares the grids is the room shoal.sea.
"""
