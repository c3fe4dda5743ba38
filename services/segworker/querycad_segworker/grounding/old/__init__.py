"""The words of a description read by a lexicon, and the parts that fit them."""
