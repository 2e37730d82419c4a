"""The section of the page about the results of the long campaigns, taken from the pages that
describe them."""

import os
import re
from html import escape

from machine import ROOT
from tables import cell, heads, row, table

HISTORIES = os.path.join(ROOT, "tests", "properties", "README.md")
FAULTS = os.path.join(ROOT, "docs", "parallel.md")


def paragraph(path, begins):
    """The paragraph with this beginning, without Markdown's marks."""
    with open(path, encoding="utf-8") as file:
        found = next(block for block in file.read().split("\n\n") if block.startswith(begins))
    return escape(re.sub(r"[`*]", "", " ".join(found.split())))


def fault_rows():
    """For each command, the number of moments for each kind of fault."""
    with open(FAULTS, encoding="utf-8") as file:
        lines = file.read().split("| command | killed |")[1].split("\n\n")[0].splitlines()[2:]
    return [[re.sub("`", "", words.strip()) for words in line.strip("|").split("|")] for line in lines]


def section():
    rows = [row(cell(escape(name), "words"), *map(cell, moments)) for name, *moments in fault_rows()]
    return ("<h2>Long campaigns</h2><p>Not measured with this report, but by <code>./dev campaign fuzz</code> and "
            f"<code>./dev campaign faults</code>.</p><p>{paragraph(HISTORIES, 'The laws of histories were held')}</p>"
            f"<p>{paragraph(FAULTS, '`./dev campaign faults` tests how failures end')}</p>"
            + table(heads("command", "killed", "a file fails", "no memory"), rows, "Moments of faults"))
