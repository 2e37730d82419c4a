"""Pages whose sentences follow their tables: figures in a sentence are computed, and what it says is checked.

A page's text has, besides words,

    @QUERY@                          the figures that the query finds, as "2.5 to 10"; "most QUERY": the greatest
    <!-- holds: QUERY < 0.9 -->      what must hold of every figure for the sentence before it to be true; the
                                     line goes, or the page is not made. Also > and =; "some QUERY": of one at least

What a query is, the page's own function knows: from its words it makes the list of figures.
"""
import operator
import re
import textwrap

WIDTH = 124
UNBROKEN = "\0"
CONDITION = re.compile(r"<!-- holds: (?P<some>some )?(?P<query>.*?) (?P<sign>[<>=]) (?P<bound>[\d.]+) -->\n?")
COMPARE = {"<": operator.lt, ">": operator.gt, "=": operator.eq}


class NotTrue(Exception):
    """A sentence says what the figures do not."""


def number(value):
    """To three digits."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def spread(values):
    least, most = number(min(values)), number(max(values))
    return least if least == most else f"{least} to {most}"


def check(text, figures):
    """Throws NotTrue, with the line and what it says, at the first condition that does not hold."""
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
    """A paragraph, or the items of a list, in lines of the same width; a table or a heading as it is."""
    if block.startswith(("#", "|", "{", "    ")):
        return block
    block = re.sub(r"\[[^\]]*\]\(", lambda link: re.sub(r"\s", UNBROKEN, link[0]), block)  # a link stays on one line
    items = re.split(r"\n(?=- )", block)
    lines = [textwrap.fill(" ".join(item.split()), WIDTH, subsequent_indent="  " if item.startswith("- ") else "",
                           break_long_words=False, break_on_hyphens=False) for item in items]
    return "\n".join(lines).replace(UNBROKEN, " ")


def told(text, figures):
    """The text with its queries answered and its conditions checked."""
    check(text, figures)
    text = re.sub(r"@(most )?([^@\n]+)@",
                  lambda query: number(max(figures(query[2]))) if query[1] else spread(figures(query[2])),
                  CONDITION.sub("", text))
    return "\n\n".join(wrapped(block) for block in text.strip("\n").split("\n\n")) + "\n"
