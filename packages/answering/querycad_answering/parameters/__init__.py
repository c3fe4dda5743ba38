"""Named, typed parameters of a model, for programs: values, poses, axes, grasps and mates, or why there are none."""

from .filling import fill_parameters

__all__ = ["fill_parameters"]
