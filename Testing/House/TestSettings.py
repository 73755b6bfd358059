"""The tables of settings in the guide are those that follow from Rendering/Settings.cmake.

Usage: TestSettings.py GUIDE TABLES [--write]     --write puts them there
"""
import re
import sys

HEAD = "| setting | unit, range | default | in ParaView | meaning |\n|---|---|---|---|---|\n"


def tables_of(text):
    """Title -> rows."""
    found = re.findall(r"^(\S[^|\n]*:)\n((?:\|.*\n)+)", text, re.M)
    return dict(found)


def main(guide_file, tables_file, write):
    with open(guide_file, encoding="utf-8") as file:
        guide = file.read()
    with open(tables_file, encoding="utf-8") as file:
        tables = tables_of(file.read())
    if len(tables) != 4:
        print(f"{tables_file} has {len(tables)} tables, not 4")
        return 1
    problems = 0
    for title, rows in tables.items():
        found = re.search(re.escape(title) + r"\n\n((?:\|.*\n)+)", guide)
        if not found:
            print(f"{guide_file} has no table below '{title}'")
            problems += 1
        elif write:
            guide = guide[: found.start(1)] + HEAD + rows + guide[found.end(1) :]
        elif found.group(1) != HEAD + rows:
            missing = sorted(set(rows.splitlines()) ^ set(found.group(1).splitlines()[2:]))
            print(f"{guide_file}, '{title}': not what Rendering/Settings.cmake says. Run this with --write.", *missing, sep="\n  ")
            problems += 1
    if write:
        with open(guide_file, "w", encoding="utf-8") as file:
            file.write(guide)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:] == ["--write"]))
