" Settings for Cascade scripts: comments, :make, gq, and the commands that run and show a script.
if exists("b:did_ftplugin")
  finish
endif
let b:did_ftplugin = 1

setlocal comments=b:##,b:# commentstring=#\ %s
setlocal expandtab shiftwidth=2 softtabstop=2
setlocal makeprg=cascade\ check\ %:S
setlocal errorformat=%f:%l:%c:\ %trror:\ %m,%f:%l:%c:\ %tarning:\ %m,%-G%.%#
setlocal formatprg=cascade\ fmt\ -
command! -buffer CascadeRun update | execute '!cascade run' expand('%:S')
command! -buffer CascadeView update | call s:View()

" Opens the live page in the browser, and leaves it open.
function! s:View() abort
  let command = ['cascade', 'view', expand('%')]
  if has('nvim')
    call jobstart(command)
  else
    call job_start(command)
  endif
endfunction

let b:undo_ftplugin = 'setlocal comments< commentstring< expandtab< shiftwidth< softtabstop<'
      \ . ' makeprg< errorformat< formatprg< | delcommand CascadeRun | delcommand CascadeView'
