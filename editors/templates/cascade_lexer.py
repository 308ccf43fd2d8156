"""A Pygments lexer for Cascade scripts. Written by editors/make.py.

    pygmentize -x -l cascade_lexer.py:CascadeLexer script.cascade
"""
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Number, Punctuation, String, Text

__all__ = ["CascadeLexer"]


class CascadeLexer(RegexLexer):
    """Colours words by the tables of the language."""

    name = "Cascade"
    aliases = ["cascade"]
    filenames = ["*.cascade"]
    mimetypes = ["text/x-cascade"]

    tokens = {
        "root": [
            (r"##(?!#).*$", Comment.Special),
            (r"#.*$", Comment.Single),
            (r'"[^"\n]*(?:"|$)', String),
            (
                r"(?:\b\d+(?:\.(?!\.)\d*)?|(?<![\w.])\.\d+)(?:[eE][+-]?\d+)?",
                Number,
            ),
            (r"\bover\s+(?:@regions@)\b", Keyword),
            (r"\b(?:@settings@)(?=\s*:)", Name.Attribute),
            (r'\b(?:@beginnings@)(?=\s+[A-Za-z_Α-ω"]|\s*[{:])', Keyword),
            (r"\b(?:@between@)\b(?!\s*[:(])", Keyword),
            (r"\b(?:@functions@)(?=\s*\()", Name.Builtin),
            (r"([:,]\s*)(@words@)\b", bygroups(Punctuation, Name.Constant)),
            (r"\b(?:@values@)\b(?!\s*[:(])", Name.Builtin.Pseudo),
            (r"\s+", Text),
            (r"[^\W\d]\w*", Name),
            (r".", Punctuation),
        ],
    }
