# bash completion of GPU shading's programs, from what each says with --help.
_gpu_shading() {
  local word=${COMP_WORDS[COMP_CWORD]} program=$1 help subcommands='' subcommand='' known
  known=$("$program" --help 2>/dev/null)
  if [[ ${program##*/} == energyplus* ]]; then known=$("$program" --gpu-shading --help 2>/dev/null); fi
  subcommands=$(sed -n '/^Subcommands:/,/^$/ s/^  \([a-z]\+\) .*/\1/p' <<<"$known")
  for known_word in $subcommands; do
    if [[ " ${COMP_WORDS[*]:1:COMP_CWORD-1} " == *" $known_word "* ]]; then subcommand=$known_word; fi
  done
  help=$known
  if [ -n "$subcommand" ]; then
    help=$("$program" "$subcommand" --help-all 2>/dev/null)
    subcommands=''
  fi
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE -- '(^ +|,| )--?[[:alnum:]][-[:alnum:]]*' <<<"$help" |
      tr -d ' ,' | sort -u)" -- "$word")
  elif [ -n "$subcommands" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$subcommands" -- "$word")
  fi
}
complete -o default -F _gpu_shading gpu_shading energyplus energyplus-gpu patch_energyplus compare_shading \
  compare_sampling
