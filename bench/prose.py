"""Pages whose sentences depend on their tables: figures in sentences are computed, and statements
are checked.

Besides words, the text of a page contains

@QUERY@                          the figures of the query, such as "2.5 to 10"; "most QUERY": the greatest
<!-- holds: QUERY < 0.9 -->      a condition on every figure, without which the preceding sentence is false; the
                                 line is removed, or the page is refused. Also > and =; "some QUERY": for at
                                 least one figure

Queries are evaluated by a function of the page, which returns a list of figures for the words of
the query.
"""
import operator
import re
import textwrap

WIDTH = 124
UNBROKEN = "\0"
CONDITION = re.compile(r"<!-- holds: (?P<some>some )?(?P<query>.*?) (?P<sign>[<>=]) (?P<bound>[\d.]+) -->\n?")
COMPARE = {"<": operator.lt, ">": operator.gt, "=": operator.eq}


class NotTrue(Exception):
    """A sentence contradicts the figures."""


def number(value):
    """Formats with three digits."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def spread(values):
    least, most = number(min(values)), number(max(values))
    return least if least == most else f"{least} to {most}"


def check(text, figures):
    """Throws NotTrue, with the line, at the first condition that does not hold."""
    for condition in CONDITION.finditer(text):
        values = figures(condition["query"])
        holds = (any if condition["some"] else all)(
            COMPARE[condition["sign"]](value, float(condition["bound"])) for value in values)
        if not values or not holds:
            line = text.count("\n", 0, condition.start()) + 1
            found = ", ".join(number(value) for value in values) or "none"
            raise NotTrue(f"line {line}: {condition['query']} should be {condition['sign']} {condition['bound']}, and is "
                          f"{found}: the sentences before it need another look")


def wrapped(block):
    """Wraps a paragraph or the items of a list; leaves tables and headings unchanged."""
    if block.startswith(("#", "|", "{", "    ")):
        return block
    block = re.sub(r"\[[^\]]*\]\(", lambda link: re.sub(r"\s", UNBROKEN, link[0]), block)  # keeps links on one line
    items = re.split(r"\n(?=- )", block)
    lines = [textwrap.fill(" ".join(item.split()), WIDTH, subsequent_indent="  " if item.startswith("- ") else "",
                           break_long_words=False, break_on_hyphens=False) for item in items]
    return "\n".join(lines).replace(UNBROKEN, " ")


def told(text, figures):
    """Returns the text with its queries evaluated and its conditions checked."""
    check(text, figures)
    text = re.sub(r"@(most )?([^@\n]+)@",
                  lambda query: number(max(figures(query[2]))) if query[1] else spread(figures(query[2])),
                  CONDITION.sub("", text))
    return "\n\n".join(wrapped(block) for block in text.strip("\n").split("\n\n")) + "\n"
