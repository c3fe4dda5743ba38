"""The page to upload a model and ask about it."""
