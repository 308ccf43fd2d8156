"""Does a manual page contain all that --help says?

usage: same_manual.py HELP PAGE

Both are files with text. Every command, argument and option of HELP must be in PAGE, followed by its whole description,
and so must all examples. Exits with 1 otherwise.
"""
import re
import sys


def words(text):
    return " ".join(text.replace("\u2010", "-").split())


def entries(text):
    """The rows of HELP in two columns, each as its name and its description."""
    rows, column = [], None
    for line in text.split("\n"):
        row = re.match(r"  (\S.*?)(?:  +(\S.*))?$", line)
        more = re.match(r" {10,}(\S.*)$", line)
        if row and not line.startswith("   "):
            rows.append([row[1], row[2] or ""])
        elif line.startswith("   ") and re.match(r" +--\S", line):  # An option without a short name.
            row = re.match(r" +(\S.*?)(?:  +(\S.*))?$", line)
            rows.append([row[1], row[2] or ""])
        elif more and rows:
            rows[-1][1] += " " + more[1]
    return rows


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        help_text = file.read()
    with open(sys.argv[2], encoding="utf-8") as file:
        page = words(file.read())
    table, _, examples = help_text.partition("Example")
    missing = []
    for name, about in entries(table):
        name = re.sub(r"(?<=\S),(?=-)", ", ", name)
        row = words(name + " " + about)
        if row not in page:
            missing.append(row)
    for line in examples.partition("\n")[2].split("\n"):
        line = words(line.removeprefix("Exit status: "))
        if line and line not in page:
            missing.append(line)
    for row in missing:
        print(f"the page lacks: {row}")
    if len(entries(table)) < 2:
        print("--help has no rows")
    return 1 if missing or len(entries(table)) < 2 else 0


sys.exit(main())
