" colours.vim -- of each script a line, of each of its bytes the letter by which kinds.py names its colour.
"
"   nvim -u NONE -i NONE --headless SYNTAX SCRIPT... -S colours.vim
set encoding=utf-8 nomore
syntax on
let s:letters = {'qdotWord': 'W', 'qdotOption': 'W', 'qdotEnd': 'W', 'qdotFunction': 'N', 'qdotValue': 'N', 'qdotConstant': 'N',
      \ 'qdotNumber': '0', 'qdotText': 'S', 'qdotComment': 'C', 'qdotTodo': 'C'}
let s:lines = []
for s:file in argv()[1:]
  execute 'edit' fnameescape(s:file)
  syntax clear
  unlet! b:current_syntax
  execute 'source' fnameescape(fnamemodify(argv()[0], ':p'))
  syntax sync fromstart
  let s:kinds = ''
  for s:n in range(1, line('$'))
    for s:column in range(1, len(getline(s:n)))
      let s:kinds .= get(s:letters, substitute(synIDattr(synID(s:n, s:column, 0), 'name'), '_.*', '', ''), 'P')
    endfor
    let s:kinds .= 'P'
  endfor
  call add(s:lines, s:kinds)
endfor
call writefile(s:lines, '/dev/stdout')
quitall!
