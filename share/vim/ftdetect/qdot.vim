" Scripts of qdot end in .lag.
autocmd BufNewFile,BufRead *.lag setfiletype qdot
