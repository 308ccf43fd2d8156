# Prints what zsh makes of the last word of a line when it completes the line. FOLDER contains the
# function _cascade.
#
# usage: zsh -f complete.zsh FOLDER LINE
zmodload zsh/zpty
zpty terminal zsh -f -i
zpty -w terminal "PS1= PS2= fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -d $PWD/zcompdump"
zpty -w terminal 'answer() { zle complete-word; print -r -- "[[$BUFFER]]"; exit; }; zle -N answer; bindkey "^T" answer'
zpty -w terminal 'print ready'
zpty -r terminal before '*ready*ready*'
zpty -w -n terminal "$2"$'\C-t'
zpty -r terminal line '*\]\]*'
line=${${line##*\[\[}%%\]\]*}
print -r -- "${${line% }##* }"
