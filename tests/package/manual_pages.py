"""The manual pages of the program: its own, and one for each subcommand."""

import re


def manual_pages(help_text):
    """Returns their names, from the output of --help."""
    listed = help_text.partition("Subcommands:\n")[2].partition("\n\n")[0]
    subcommands = re.findall(r"^  (\S+)", listed, re.MULTILINE)
    if "refine" not in subcommands:
        raise AssertionError(f"this lists no subcommands:\n{help_text}")
    return ["octetra", *(f"octetra-{word}" for word in subcommands)]
