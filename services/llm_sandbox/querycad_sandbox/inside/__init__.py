"""Python that runs inside the interpreter, ahead of a program; the host reads it as text."""
