"""Pages of the documentation whose tables programs write.

What stands between <!-- begin NAME --> and <!-- end NAME --> is replaced; the rest of the text is
left as it is.
"""
import re
import sys


def number(value):
    if value == 0:
        return "0"
    if abs(value) < 1e-3:
        return f"{value:.0e}".replace("e-0", "e-")
    return f"{value:.3g}"


def percent(value):
    return "0" if value == 0 else f"{100 * value:.2g} %" if value < 0.1 else f"{100 * value:.0f} %"


def table(head, lines):
    out = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(out + ["| " + " | ".join(line) + " |" for line in lines])


def fill(path, sections, rows):
    """Replaces the tables of a page; sections: a function of the rows for each name."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for name, make in sections.items():
        pattern = re.compile(f"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.DOTALL)
        if not pattern.search(text):
            sys.exit(f"{path} has no place for the table {name}")
        content = make(rows)
        text = pattern.sub(lambda found: found[1] + content + "\n" + found[2], text)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
