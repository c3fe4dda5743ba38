"""SegCAD's vision path: render, detect, segment, align, prune, merge (QueryCAD paper, section SegCAD), then fuse."""
