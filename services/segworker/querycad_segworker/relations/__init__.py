"""What parts are to one another by where they lie: in, on, beside, between, radial to. Geometry, and no words."""
