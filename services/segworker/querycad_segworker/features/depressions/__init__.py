"""What is cut into the material: pockets, slots, notches, grooves of any section, cutouts, cavities."""
