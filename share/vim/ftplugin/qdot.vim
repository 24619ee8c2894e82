" Scripts of qdot: comments, brackets that go on, and :make runs this file.
if exists("b:did_ftplugin")
  finish
endif
let b:did_ftplugin = 1

setlocal comments=:# commentstring=#\ %s
setlocal expandtab shiftwidth=4
setlocal makeprg=qdot\ -q\ %:S
setlocal errorformat=%f:%l:%c:\ error:\ %m,%-G%.%#
nnoremap <buffer> <silent> <F5> :update<CR>:make<CR>

let b:undo_ftplugin = "setlocal comments< commentstring< expandtab< shiftwidth< makeprg<"
      \ . " errorformat< | silent! nunmap <buffer> <F5>"
