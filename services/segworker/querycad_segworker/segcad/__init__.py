"""SegCAD, as published (QueryCAD paper): `pipeline` runs render, detect, segment, align, prune and merge."""
