"""What stands out of the material with plane sides or any outline: pads, prisms, ribs."""
