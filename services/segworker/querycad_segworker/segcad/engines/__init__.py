"""What finds boxes and masks: the networks, how their graphs are run, and stand-ins for them."""
