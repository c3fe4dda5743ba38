"""Deterministic feature recognition on the attributed adjacency graph of the B-rep.

One package a group of families, one module a family; each has `recognise_<family>(…) -> list[Record]` with frozen
records. `parts` makes the records parts of the model; `recognise.py` runs them all.
"""
