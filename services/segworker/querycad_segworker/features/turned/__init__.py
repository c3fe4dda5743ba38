"""What is round or toothed about an axis: bosses, shafts, grooves, gears, knurls, pipes."""
