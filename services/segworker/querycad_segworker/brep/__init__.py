"""The CAD kernel's room: the only place that imports OCP, and the only one where millimetres exist."""
