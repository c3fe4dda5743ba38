"""From one question to one answer: a program is written, run and judged, and its result typed."""
