"""How the parts of render.py end it."""


class Failure(Exception):
    """What the user is told before the program ends."""
