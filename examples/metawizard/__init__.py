"""A gear that a robot puts on an engine block's shaft: scene, program synthesiser, kinematic check."""
