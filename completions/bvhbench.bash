# SPDX-License-Identifier: MIT
# Completes commands, options and names of bvhbench in bash:
#   source completions/bvhbench.bash
# and in zsh, after `autoload -U bashcompinit && bashcompinit`.
#
# Words come from the program's own help and lists; before the program is built only commands are completed.

# _bvhbench_ask KEY WORDS...: prints what the program answers, asked once a shell for each KEY.
declare -gA _bvhbench_answers
_bvhbench_ask() {
    local key=$1
    shift
    [[ -n ${_bvhbench_answers[$key]:-} ]] || _bvhbench_answers[$key]=$("$@" 2>/dev/null)
    printf '%s\n' "${_bvhbench_answers[$key]}"
}

# _bvhbench_list PROGRAM WHAT: the names of `list WHAT`.
_bvhbench_list() { _bvhbench_ask "list $2" "$1" list "$2" | awk '{print $1}'; }

_bvhbench() {
    local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local commands each command='' names=''
    COMPREPLY=()
    commands=$(_bvhbench_ask --help "$program" --help | sed -n '/^Know/,/^Exit codes/s/^  \([a-z][a-z-]*\)  .*/\1/p')
    for each in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        if [[ $'\n'$commands$'\n' == *$'\n'$each$'\n'* ]]; then
            command=$each
            break
        fi
    done
    [[ ! -f ${program%/*}/packages.txt || -x ${program%/*}/build/release/harness/bvhbench ]] || before=help
    case $before in
        --builder | --builders) names=$(_bvhbench_list "$program" builders) ;;
        --collider | --colliders) names=$(_bvhbench_list "$program" colliders) ;;
        --order | --orders) names=$(_bvhbench_list "$program" orders) ;;
        --boxes) names=$(_bvhbench_list "$program" formats) ;;
        --narrow) names=$(_bvhbench_list "$program" narrow) ;;
        --no-skip | --force-skip) names=$(_bvhbench_list "$program" skips) ;;
        --scene | --scenes | cluster) names=$(_bvhbench_list "$program" scenes) ;;
        run | reproduce) names=$(_bvhbench_list "$program" experiments) ;;
        list) names=$(_bvhbench_ask "list --help" "$program" list --help | sed -n '/WHAT WORD/,/^$/p' | grep -o '\b[a-z]\+' | grep -vx 'required\|or') ;;
        help) names=$commands ;;
        *)
            if [[ $word == -* ]]; then
                names=$(_bvhbench_ask "$command --help" "$program" $command --help | grep -o -- '--[a-z][a-z-]*' | sort -u)
                [[ -z $command ]] || names+=" $(_bvhbench_ask --help "$program" --help | sed -n 's/^  *\(-h,\)*\(--[a-z-]*\).*/\2/p')"
            elif [[ -z $command ]]; then
                names=$commands
            fi
            ;;
    esac
    COMPREPLY=($(compgen -W "$names" -- "$word"))
    [[ $word == -* || -z $command ]] || COMPREPLY+=($(compgen -f -- "$word"))
}

complete -o filenames -F _bvhbench bvhbench ./bvhbench
