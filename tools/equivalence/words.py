"""Formats of numbers."""


def count(number):
    """1234567 as 1,234,567."""
    return f"{number:,}"


def size(number_of_bytes):
    """A size of a file or of messages, with three digits."""
    value = float(number_of_bytes)
    for unit in ("B", "kB", "MB", "GB"):
        if value < 999.5 or unit == "GB":
            break
        value /= 1000
    return f"{value:.0f} {unit}" if unit == "B" else f"{value:.3g} {unit}"


def seconds(value):
    """With two or three digits, in s or ms."""
    if value < 0.0995:
        return f"{1000 * value:.2g} ms" if value < 0.00995 else f"{1000 * value:.0f} ms"
    return f"{value:.2f} s" if value < 99.5 else f"{value:.0f} s"


def degrees(value):
    """An angle with three digits if it is small."""
    return f"{value:.1f}°" if value >= 1 else f"{value:.2g}°"


def plural(number, noun):
    """1 run, 2 runs; nouns with an irregular plural are given as "mesh/meshes"."""
    one, _, many = noun.partition("/")
    return f"{count(number)} {one if number == 1 else many or one + 's'}"
