"""How `./run evaluate`, `tables`, `zoo` and `foreign` do many tasks at once: on this machine, or on a cluster."""
