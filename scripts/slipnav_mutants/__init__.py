"""Mutants of the core: small changes to its code that a unit test has to notice."""
