#!/usr/bin/env bash
# usage: ask.bash <directory of completions> <word>...   Prints what bash would offer for the last word, a line each.
. "$1/$2"
shift
# Only the line editor may set its options.
compopt() { :; }
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
function=$(complete -p "$1" | sed 's/.* -F \([^ ]*\) .*/\1/')
"$function" "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}"
