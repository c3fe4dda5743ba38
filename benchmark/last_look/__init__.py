"""Models and questions of four hands that were sealed until the reader of questions was done, and looked at once."""
