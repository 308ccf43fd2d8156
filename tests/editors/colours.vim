" Writes the classes of all characters to vim.out, as lines "LINE:FIRST-LAST CLASS".
let lines = []
for line in range(1, line('$'))
  let classes = []
  for column in range(1, len(getline(line)))
    let class = tolower(substitute(synIDattr(synID(line, column, 0), 'name'), '^cascade', '', ''))
    call add(classes, getline(line)[column - 1] =~ '\s' && class !~ 'comment\|doc\|string' ? '' : class)
  endfor
  let first = 0
  while first < len(classes)
    let last = first
    while last + 1 < len(classes) && classes[last + 1] ==# classes[first]
      let last += 1
    endwhile
    if classes[first] !=# ''
      call add(lines, line . ':' . (first + 1) . '-' . (last + 1) . ' ' . classes[first])
    endif
    let first = last + 1
  endwhile
endfor
call writefile(lines, 'vim.out')
quitall!
