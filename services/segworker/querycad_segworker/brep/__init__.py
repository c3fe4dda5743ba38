"""The only package that imports the CAD kernel (OCP), and the only one that works in millimetres."""
