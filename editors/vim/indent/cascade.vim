" Two columns for each open brace, and four within brackets.
if exists("b:did_indent")
  finish
endif
let b:did_indent = 1

setlocal indentexpr=CascadeIndent(v:lnum) indentkeys=0{,0},o,O
let b:undo_indent = 'setlocal indentexpr< indentkeys<'

function! CascadeIndent(line) abort
  let before = prevnonblank(a:line - 1)
  if before == 0
    return 0
  endif
  let text = substitute(getline(before), '#.*$\|"[^"]*"', '', 'g')
  let opened = count(text, '{') - count(text, '}') + (text =~ '^\s*}' ? 1 : 0)
  let brackets = count(text, '(') - count(text, ')')
  let closes = getline(a:line) =~ '^\s*}' ? 1 : 0
  return max([0, indent(before) + 2 * (opened - closes) + 4 * brackets])
endfunction
