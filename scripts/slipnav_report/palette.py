"""The colors of src/overlay/palette.h, so that plots and rviz look alike; a test compares them."""

ESTIMATE = "#0072B2"
TRUTH = "#E69F00"
DEAD_RECKONING = "#CC79A7"
STOP = "#009E73"
ERROR = "#D55E00"
TEXT = "#222222"
SAFE = "#56B4E9"
WARNING = "#F0E442"

# Instead of those that are too dark on a dark page; in lower case, as matplotlib writes colors.
ON_DARK = {ESTIMATE.lower(): "#4fb3f0", STOP.lower(): "#2cc99b", ERROR.lower(): "#ff8a3c", TEXT: "#dddddd"}

# Of three axes, where each figure says which is which.
AXES = (ESTIMATE, ERROR, STOP)
STANDSTILL = "0.9"
