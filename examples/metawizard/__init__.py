"""A gear that a robot puts on an engine block's shaft: the scene, a small program synthesiser, and a kinematic check."""
