# Bash completion for dynamicfilter. Asks the command itself, so it knows what the command knows.
_dynamicfilter() {
    local word=${COMP_WORDS[COMP_CWORD]} help
    if ((COMP_CWORD == 1)); then
        help=$("$1" --help 2> /dev/null | sed -n '/^Subcommands:/,$ s/^  \([a-z]*\) .*/\1/p')
    elif [[ $word == -* ]]; then
        help=$("$1" "${COMP_WORDS[1]}" --help 2> /dev/null | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--.*')
    else
        return  # files, by -o default
    fi
    mapfile -t COMPREPLY < <(compgen -W "$help" -- "$word")
}
complete -o default -F _dynamicfilter dynamicfilter
