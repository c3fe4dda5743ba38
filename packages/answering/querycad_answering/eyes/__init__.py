"""A model that takes images says which numbered marks a phrase means: see docs/segcad.md."""
