"""Pictures of a model and which faces each of their pixels shows."""
