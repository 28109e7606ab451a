#!/usr/bin/env zsh
# usage: ask.zsh <directory of completions> <word>...   Prints what zsh would offer for the last word, a line each.
# zsh completes only where it reads keys: a second one, on a pseudo-terminal, gets the line and a tab. There, compadd
# prints what it is given between two lines that hold a NUL.
# The list of all completions takes seconds to make: .zcompdump in the current directory keeps it, for more questions.
zmodload zsh/zpty
setup=$(mktemp)
trap 'rm -rf $setup' EXIT
cat >$setup <<END
PROMPT=
fpath=(${(q)1} \$fpath)
autoload -Uz compinit && compinit -u -d \$PWD/.zcompdump
bindkey '^I' complete-word
mark() { print -r -- \$'\0' }
compprefuncs=(mark)
comppostfuncs=(mark exit)
compadd() {
  if [[ \${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
    builtin compadd "\$@"
    return
  fi
  local -a hits
  builtin compadd -A hits "\$@"
  (( \$#hits == 0 )) || print -rl -- \$hits
}
print ready
END
shift
zpty asked zsh -f -i
zpty -w asked "source ${(q)setup}"
repeat 10; do
  zpty -r asked line
  [[ $line == ready* ]] && break
done
zpty -w -n asked "$*"$'\t'
integer marks=0
while zpty -r asked line; do
  if [[ $line == *$'\0'* ]]; then
    (( ++marks == 2 )) && break
  elif (( marks == 1 )); then
    print -r -- ${line%%$'\r\n'}
  fi
done
