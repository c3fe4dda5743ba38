"""What did the stages see, and how well do they do? Their pictures, and what they give back of known parts."""
