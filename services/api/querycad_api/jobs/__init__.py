"""Asked questions on their way to an answer, and the answers' pictures."""
