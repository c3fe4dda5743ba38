"""Records of features become parts of the model: their measures, volumes, patterns and relations."""
