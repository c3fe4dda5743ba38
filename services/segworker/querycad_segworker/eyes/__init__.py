"""Pictures with numbered marks for whoever takes images, and what he saw in them: see docs/segcad.md."""
