"""From a form and the parts that it was grounded on to a Python program over the guest API."""

from .builder import Grounds, Unwritable, Written
from .writer import write

__all__ = ["Grounds", "Unwritable", "Written", "write"]
