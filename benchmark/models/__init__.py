"""The benchmark's models, one script each: parameters, `build(p)`, `questions(p)` and what kind of file it becomes."""
