"""What prevents an import."""


class Failure(Exception):
    """One sentence: what is wrong, where, and what to do about it."""
