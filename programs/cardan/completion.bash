# Completion of `cardan` in bash. Commands, options and machines are those that the program's own --help names.

_cardan_words() { # COMMAND: its options, the values they allow and the built-in machines
    case "$1" in
        options) "$2" "$3" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*' ;;
        values) # of an option with a list: --generator TEXT:{free,locked}
            "$2" "$3" --help 2>/dev/null | sed -nE "s/^ *${4} [A-Z]*:\{([^}]*)\}.*/\1/p" | tr ',' '\n' ;;
        machines) "$2" "$3" --help 2>/dev/null | sed -nE '/or one$|or one of:$/,$s/^  ([a-z][a-z0-9-]*)  .*/\1/p' ;;
        commands) "$2" --help 2>/dev/null | sed -nE 's/^  ([a-z]+) .*/\1/p' ;;
    esac
}

_cardan() {
    local program="${COMP_WORDS[0]}" command="${COMP_WORDS[1]:-}" word="${COMP_WORDS[COMP_CWORD]}"
    local previous="${COMP_WORDS[COMP_CWORD - 1]}" words=""
    # Bash takes --wake=dynamic as three words.
    if [[ "$word" == = ]]; then
        word=""
    elif [[ "$previous" == = ]]; then
        previous="${COMP_WORDS[COMP_CWORD - 2]}"
    fi
    if ((COMP_CWORD == 1)); then
        words="$(_cardan_words commands "$program") help --help --version"
    elif [[ "$command" == help ]]; then
        words="$(_cardan_words commands "$program")"
    elif [[ "$word" == -* ]]; then
        words="$(_cardan_words options "$program" "$command")"
    elif [[ "$previous" == --* ]]; then
        words="$(_cardan_words values "$program" "$command" "$previous")"
    else
        words="$(_cardan_words machines "$program" "$command")"
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    # Nothing of that name: a file.
    if ((COMP_CWORD > 1)) && [[ "$word" != -* ]]; then
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$word")
    fi
}
complete -o filenames -F _cardan cardan
