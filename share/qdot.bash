# Completion of qdot's command line for bash.
_qdot()
{
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}

    # bash takes --processor=KIND apart at the `=`
    if [[ $word == = && $before == --processor ]]; then
        COMPREPLY=(any avx2 avx512)
        return
    fi
    if [[ $before == = && ${COMP_WORDS[COMP_CWORD - 2]} == --processor ]]; then
        mapfile -t COMPREPLY < <(compgen -W 'any avx2 avx512' -- "$word")
        return
    fi
    case $before in
    -e | --execute) return ;;
    --processor)
        mapfile -t COMPREPLY < <(compgen -W 'any avx2 avx512' -- "$word")
        return
        ;;
    esac
    case $word in
    -*)
        mapfile -t COMPREPLY < <(compgen -W '-e --execute= -i --interactive --json --lsp --no-init -q --quiet
            --processor= -h --help -V --version' -- "$word")
        [[ ${COMPREPLY[0]-} != *= ]] || compopt -o nospace
        ;;
    *)
        compopt -o filenames
        mapfile -t COMPREPLY < <(compgen -f -X '!*.lag' -- "$word"; compgen -d -- "$word")
        ;;
    esac
}
complete -F _qdot qdot
