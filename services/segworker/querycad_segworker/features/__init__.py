"""Deterministic feature recognition on the attributed adjacency graph of the B-rep.

One module a family; each has `recognise_<family>(…) -> list[Record]` with frozen records. `recognise.py` runs them all.
"""
