"""What `./run tables` does: simulated drives for the paper's tables and its figure, beside the paper's own numbers."""
