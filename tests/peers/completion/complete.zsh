#!/usr/bin/env zsh
# Types the beginnings of commands into an interactive zsh with our completion, presses Tab, and
# checks what zsh makes of them.
#
#   zsh complete.zsh springlod.zsh

emulate -R zsh
zmodload zsh/zpty
local file=${1:A} folder screen failed=0
zsh -n $file || exit 1

# As installed: a file of fpath, named as the function.
folder=$(mktemp -d)
trap 'zpty -d shell 2>/dev/null; rm -rf $folder' EXIT
cp $file $folder/_springlod
cd $folder
touch body.obj scene.lua

export TERM=dumb
zpty -b shell zsh -f -i
# Reads the screen up to a text.
wait_for() {
  local piece
  screen=
  for (( i = 0; i < 3000; i++ )); do
    while zpty -r -t shell piece; do screen+=$piece; done
    [[ $screen == *$1* ]] && return 0
    sleep 0.02
  done
  print -u2 -r -- "no '$1' on the screen: $screen"
  exit 1
}
# Ctrl-X prints the line that is being typed and empties it.
zpty -w shell "fpath=($folder \$fpath); autoload -U compinit; compinit -u -D; PS1=; LISTMAX=1000
setopt no_always_last_prompt no_auto_menu
show() { print -r -- \"line <\$BUFFER>\"; BUFFER= }; zle -N show; bindkey '^X' show; print rea'dy'"
wait_for ready

# check TYPED LINE [SHOWN...]: Tab after TYPED makes it LINE, and the list shows each SHOWN; a word
# that begins with ! is not shown.
check() {
  local typed=$1 line=$2 word
  shift 2
  zpty -w -n shell "$typed"$'\t'$'\x18'
  wait_for '>'
  [[ $screen == *"line <$line>"* ]] || { print -u2 -r -- "'$typed' became: $screen"; failed=1 }
  for word in $@; do
    if [[ $word == !* ]]; then
      [[ $screen == *${word#!}* ]] && { print -u2 -r -- "'$typed' shows ${word#!}: $screen"; failed=1 }
    else
      [[ $screen == *$word* ]] || { print -u2 -r -- "'$typed' does not show $word: $screen"; failed=1 }
    fi
  done
}

check 'springlod exp' 'springlod export '
check 'springlod re' 'springlod re' render refinement !export
check 'springlod --thr' 'springlod --threads='
check 'springlod -q --seed 3 conv' 'springlod -q --seed 3 convert '
check 'springlod convert --unit ' 'springlod convert --unit ' mm ft
check 'springlod convert --unit=i' 'springlod convert --unit=in '
check 'springlod convert --uni' 'springlod convert --unit='
check 'springlod convert --thr' 'springlod convert --threads='
check 'springlod convert --mem' 'springlod convert --mem'  # only before the command
check 'springlod convert bo' 'springlod convert body.obj '
check 'springlod convert a.obj bo' 'springlod convert a.obj body.obj '
check 'springlod compare --scenario ' 'springlod compare --scenario scene.lua '
check 'springlod export -o sc' 'springlod export -o scene.lua '
check 'springlod export x.glb --to muj' 'springlod export x.glb --to mujoco '
check 'springlod run ' 'springlod run scene.lua '
check 'springlod compare --seed 2 --seed' 'springlod compare --seed 2 --seed'
exit $failed
