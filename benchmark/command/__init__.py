"""What `querycad bench` does."""
