"""What `./run evaluate` does with several recordings: all of them on all cores, one table, one page."""
