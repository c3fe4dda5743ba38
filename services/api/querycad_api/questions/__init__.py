"""Questions about a model, asked over HTTP."""
