"""`./run evaluate` with several recordings: on all cores, one table, one page."""
