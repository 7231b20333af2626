"""`./run zoo` and `./run foreign`: drives in worlds and on robots not used for tuning, and their limits."""
