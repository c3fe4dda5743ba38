"""Two hands on twenty models of their own: sealed before the reader was written, looked at once, at the end."""
