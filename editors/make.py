#!/usr/bin/env python3
"""editors/make.py CASCADE [--check]: writes the grammars of editors.

The words of the language come from `CASCADE lsp --words`, everything else from the files in
editors/templates. There, @functions@ stands for the functions with "|" between them, and
@functions:FORM@ for another form of the list (FORMS). With --check nothing is written, and the
status is 1 if a file differs.
"""
import json
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path(__file__).parent
# The file that each template becomes.
FILES = {
    "cascade.tmLanguage.json": "vscode/syntaxes/cascade.tmLanguage.json",
    "cascade.vim": "vim/syntax/cascade.vim",
    "cascade-mode.el": "emacs/cascade-mode.el",
    "cascade.xml": "kate/cascade.xml",
    "cascade_lexer.py": "pygments/cascade_lexer.py",
}
FORMS = {
    None: "|".join,
    "vim": "\\|".join,
    "lisp_or": "\\\\|".join,
    "lisp": lambda words: " ".join(f'"{word}"' for word in words),
}


def filled(template, words):
    def listed(found):
        # Longer words come first, because some grammars take the first that fits.
        return FORMS[found[2]](sorted(words[found[1]], key=lambda word: (-len(word), word)))

    return re.sub(r"@(\w+)(?::(\w+))?@", listed, template)


def main(cascade, check):
    printed = subprocess.run([cascade, "lsp", "--words"], check=True, capture_output=True).stdout
    words = json.loads(printed)
    differing = []
    for template, name in FILES.items():
        path = FOLDER / name
        text = filled((FOLDER / "templates" / template).read_text("utf-8"), words)
        if path.exists() and path.read_text("utf-8") == text:
            continue
        differing.append(str(path))
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
    if check and differing:
        sys.exit("editors/make.py makes these files otherwise: " + ", ".join(differing))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--check"]):
        sys.exit(__doc__)
    main(sys.argv[1], len(sys.argv) == 3)
