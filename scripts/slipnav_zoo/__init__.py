"""What `./run zoo` and `./run foreign` do: drives on worlds and robots that nothing was tuned on, and their limits."""
