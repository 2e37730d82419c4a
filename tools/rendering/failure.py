"""Reports failures of the parts of render.py."""


class Failure(Exception):
    """A message that is printed before the program ends."""
