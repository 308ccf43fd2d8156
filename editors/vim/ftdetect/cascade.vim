autocmd BufNewFile,BufRead *.cascade setfiletype cascade
