"""Pictures with numbered marks for vision models, and what these saw in them: see docs/segcad.md."""
