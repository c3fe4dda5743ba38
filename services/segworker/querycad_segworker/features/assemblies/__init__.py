"""What bodies are to each other: bearings, screws and nuts, and the bodies themselves."""
