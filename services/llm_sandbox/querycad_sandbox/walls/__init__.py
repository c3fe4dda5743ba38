"""The walls around an interpreter: another user, limits, Landlock, seccomp, a clean environment."""
