"""Which faces does one see, from where? Cameras, face ids of each pixel, and the sides that show a part."""
