#!/usr/bin/env bash
# The grammars of editors are what editors/make.py makes of the tables of the language, and all of them give
# tests/editors/sample.cascade the colours of tests/editors/sample.colours. Grammars whose program is missing are named.
set -u
export PYTHONDONTWRITEBYTECODE=1
fail() { echo "editors: $*"; exit 1; }

python3 "$SOURCE/editors/make.py" "$CASCADE" --check || fail "run editors/make.py"
sample=$SOURCE/tests/editors/sample.cascade
expected=$SOURCE/tests/editors/sample.colours
tried=()

# compare NAME: the colours on standard input, as lines "LINE:FIRST-LAST CLASS".
compare() {
    cat >"$1.colours"
    diff "$expected" "$1.colours" >"$1.diff" || fail "$1 colours words otherwise: $(cat "$1.diff")"
    tried+=("$1")
}

has() { command -v "$1" >/dev/null || { echo "editors: not tried: $1 is missing"; return 1; }; }

if has vim; then
    vim -Nu NONE -i NONE -n -es -c "set rtp^=$SOURCE/editors/vim | syntax on | filetype plugin indent on" \
        -c "source $SOURCE/tests/editors/colours.vim" "$sample" </dev/null
    compare vim <vim.out
    cp "$sample" indent.cascade
    sed -i 's/^ *//' indent.cascade
    vim -Nu NONE -i NONE -n -es -c "set rtp^=$SOURCE/editors/vim | syntax on | filetype plugin indent on" \
        -c "edit indent.cascade" -c 'normal gg=G' -c 'wq' </dev/null
    diff "$sample" indent.cascade || fail "vim indents otherwise"
fi
if python3 -c 'import pygments' 2>/dev/null; then
    python3 "$SOURCE/tests/editors/colours.py" "$SOURCE/editors/pygments" "$sample" >pygments.out
    compare pygments <pygments.out
else
    echo "editors: not tried: pygments is missing"
fi
if has kate-syntax-highlighter; then
    mkdir -p data/org.kde.syntax-highlighting/syntax
    cp "$SOURCE/editors/kate/cascade.xml" data/org.kde.syntax-highlighting/syntax/
    XDG_DATA_HOME=$PWD/data QT_QPA_PLATFORM=offscreen kate-syntax-highlighter -s Cascade -t 'Breeze Light' -f html \
        "$sample" >kate.html || fail "kate-syntax-highlighter"
    python3 "$SOURCE/tests/editors/kate_colours.py" kate.html >kate.out
    compare kate <kate.out
fi
if has emacs; then
    emacs -Q --batch -L "$SOURCE/editors/emacs" -l "$SOURCE/tests/editors/colours.el" "$sample" >emacs.out
    compare emacs <emacs.out
fi
if has node; then
    if "$SOURCE/tests/lsp/install.sh"; then
        node "$SOURCE/tests/editors/colours.mjs" "$SOURCE/editors/vscode/syntaxes/cascade.tmLanguage.json" "$sample" >textmate.out
        compare textmate <textmate.out
    else
        echo "editors: not tried: the packages of tests/lsp"
    fi
fi
[ ${#tried[@]} -ge 2 ] || fail "only ${tried[*]-none} of the grammars could be tried"
echo "the same colours in ${tried[*]}"
