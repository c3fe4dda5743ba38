"""What vision found, beside what geometry recognised: the stage after those of the paper, see docs/segcad.md."""
