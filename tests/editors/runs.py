"""Prints runs of characters of one class."""


def print_runs(text, classes):
    """Prints lines "LINE:FIRST-LAST CLASS". classes[k] is the class of text[k], or ""."""
    start = 0
    for number, line in enumerate(text.split("\n"), 1):
        first = 0
        while first < len(line):
            last = first
            while last + 1 < len(line) and classes[start + last + 1] == classes[start + first]:
                last += 1
            if classes[start + first]:
                print(f"{number}:{first + 1}-{last + 1} {classes[start + first]}")
            first = last + 1
        start += len(line) + 1
