"""How well are questions understood? Data, fitting and cross-validation of the weights that rank readings."""
