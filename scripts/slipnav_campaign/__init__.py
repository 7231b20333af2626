"""How `./run evaluate`, `tables`, `zoo` and `foreign` run many tasks at once: on this machine, or on a cluster."""
