"""Pictures of a model for people and networks, and what viewers draw."""
