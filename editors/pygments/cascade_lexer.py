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
            (r"\bover\s+(?:touching|domain|near)\b", Keyword),
            (r"\b(?:largest_step|directions|iterations|laplacian|metalness|precision|roughness|tolerance|undiluted|boundary|duration|emission|founders|interval|opacity|spacing|stencil|stretch|surface|border|bottom|detail|divide|extent|facing|frozen|height|length|metric|remove|solver|about|along|cells|check|color|every|front|reach|right|shape|sides|speed|start|title|until|width|back|body|cite|grid|left|mask|mesh|seed|show|size|skin|tilt|unit|die|top|up)(?=\s*:)", Name.Attribute),
            (r'\b(?:system_name|picture|domain|system|cells|shape|stage|let|use|fn)(?=\s+[A-Za-z_Α-ω"]|\s*[{:])', Keyword),
            (r"\b(?:after|over|and|not|in|or)\b(?!\s*[:(])", Keyword),
            (r"\b(?:smoothstep|symmetric|transport|convolve|distance|diamond|diffuse|lattice|palette|shifted|advect|length|normal|random|stripe|tensor|vector|along|atan2|clamp|cross|field|floor|gauss|grad2|hypot|image|noise|round|white|acos|asin|atan|attr|cbrt|ceil|cosh|curl|disc|grad|keys|mean|ring|sign|sinh|sqrt|step|tanh|unit|abs|box|cos|div|dot|dxx|dxy|dxz|dyy|dyz|dzz|exp|lap|log|max|min|mix|mod|own|pow|rgb|sin|sum|tan|dx|dy|dz|if)(?=\s*\()", Name.Builtin),
            (r"([:,]\s*)(symplectic|isotropic|creature|gradient|implicit|periodic|vertices|feather|giraffe|leopard|coarse|double|etdrk4|fourth|noflux|single|sphere|steady|euler|faces|fixed|plate|slope|thorn|torus|zebra|auto|axis|ball|fish|flux|frog|hair|imex|knot|rk23|rk45|rkl1|rkl2|ros2|turk|rk2|rk4|fv)\b", bygroups(Punctuation, Name.Constant)),
            (r"\b(?:curvature_gauss|curvature_high|curvature_mean|curvature_low|curvature|step|nx|ny|nz|pi|sx|sy|sz|t|x|y|z)\b(?!\s*[:(])", Name.Builtin.Pseudo),
            (r"\s+", Text),
            (r"[^\W\d]\w*", Name),
            (r".", Punctuation),
        ],
    }
