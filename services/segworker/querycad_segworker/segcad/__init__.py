"""SegCAD: from a description in words to the parts that it means, and to the sides they are visible from."""
