"""What `--report` draws: figures of one run, and the page that holds them."""
