"""What every family of features rests on: axes, walls, frames, adjacency, outlines, refusals."""
