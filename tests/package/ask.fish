#!/usr/bin/env fish
# usage: ask.fish <directory of completions> <word>...   Prints what fish would offer for the last word, a line each.
set fish_complete_path $argv[1] $fish_complete_path
complete -C "$argv[2..]" | string replace -r '\t.*' ''
