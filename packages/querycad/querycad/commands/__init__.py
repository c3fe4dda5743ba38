"""The commands of `querycad`, a module each; `arguments` says what each understands."""
