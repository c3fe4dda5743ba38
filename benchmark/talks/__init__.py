"""Questions that need company: others before them, a selection, printed ids, a unit, a table; `python -m` runs them."""
