"""`./run tables`: simulated drives for the paper's tables and its figure, next to the paper's own numbers."""
