"""Triangles as a B-rep: files of meshes are read, and plane and round faces fitted to them. No kernel is needed."""
