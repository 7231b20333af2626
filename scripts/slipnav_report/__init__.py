"""The plots of `--report`: figures of one run, and the page that contains them."""
