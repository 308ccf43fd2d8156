"""colours.py FOLDER SCRIPT: the colours that the Pygments lexer in FOLDER gives to a script."""
import sys

sys.path.insert(0, sys.argv[1])
from cascade_lexer import CascadeLexer  # noqa: E402
from pygments.token import Comment, Keyword, Name, Number, String  # noqa: E402
from runs import print_runs  # noqa: E402

CLASSES = {
    Comment.Special: "doc",
    Comment.Single: "comment",
    String: "string",
    Number: "number",
    Keyword: "keyword",
    Name.Attribute: "setting",
    Name.Builtin: "function",
    Name.Constant: "word",
    Name.Builtin.Pseudo: "value",
}

text = open(sys.argv[2], encoding="utf-8").read()
classes = [""] * len(text)
for start, kind, value in CascadeLexer().get_tokens_unprocessed(text):
    for k in range(start, start + len(value)):
        is_quoted = CLASSES.get(kind) in ("doc", "comment", "string")
        classes[k] = CLASSES.get(kind, "") if is_quoted or not text[k].isspace() else ""
print_runs(text, classes)
