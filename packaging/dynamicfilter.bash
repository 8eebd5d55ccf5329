# Bash completion for dynamicfilter. Asks the command itself, so it knows what the command knows.
_dynamicfilter() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words
    # `--preset paper` and `--preset=paper`: bash takes the sign for a word.
    [[ $before == "=" ]] && before=${COMP_WORDS[COMP_CWORD - 2]}
    [[ $word == "=" ]] && word=""
    if ((COMP_CWORD == 1)); then
        words=$("$1" --help 2> /dev/null | sed -n '/^Subcommands:/,$ s/^  \([a-z]*\) .*/\1/p')
    elif [[ $before == --set ]]; then
        words=$("$1" config 2> /dev/null | awk -F'[][ =]+' '/^\[/ {section = $2 "."} /^[a-z]/ {print section $1 "="}')
        compopt -o nospace
    elif [[ $before == --* ]]; then  # one of {a,b,c}, if that is what its help says
        words=$("$1" "$command" --help 2> /dev/null | grep -E -- "(^|[ ,])$before " | grep -oE '\{[^}]*\}' | tr '{,}' ' ')
        [[ -n $words ]] || return  # a file
    elif [[ $word == -* ]]; then
        words=$("$1" "$command" --help 2> /dev/null | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--.*')
    elif ((COMP_CWORD == 2)); then
        words=$("$1" "$command" --help 2> /dev/null | sed -n 's/^  [A-Z]* {\([^}]*\)}.*/\1/p' | tr ',' ' ')
        [[ -n $words ]] || return
    else
        return  # files, by -o default
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _dynamicfilter dynamicfilter
