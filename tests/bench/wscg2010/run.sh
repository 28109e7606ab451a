#!/usr/bin/env bash
# The experiment of the 2010 paper (Saraiva, Oliveira, Madeiras Pereira, WSCG 2010) by one command: errors, frame times,
# bytes and pictures, and what has become of its claims. A quarter of an hour on two cores, no GPU needed.
# usage: tests/bench/wscg2010/run.sh <directory of the programs> <directory of the models> <output directory> [--quick] [--keep]
# The models: nefertiti.obj, and a statue of two million triangles that farcell generate makes of it.
# --quick: rough figures in minutes. --keep: copies results.md, errors.csv and the statue's pictures beside this script.
set -euo pipefail
if (($# < 3)); then
  sed -n '4p' "$0" | sed 's/^# //' >&2
  exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "$1" && pwd) models=$(cd "$2" && pwd)
mkdir -p "$3"
output=$(cd "$3" && pwd)
shift 3
quick=() keep=
for option; do
  case $option in
    --quick) quick=(--quick) ;;
    --keep) keep=yes ;;
    *) echo "run.sh: unknown option $option" >&2 && exit 2 ;;
  esac
done

statue=$output/statue.ply
[[ -f $statue ]] || "$bin/farcell" generate statue --from "$models/nefertiti.obj" --triangles 2M -o "$statue"
"$bin/bench_wscg2010" --model "$models/nefertiti.obj" --model "$statue" -o "$output" "${quick[@]}"
if [[ -n $keep ]]; then
  cp "$output/results.md" "$output/errors.csv" "$here/"
  cp "$output/statue/sheet.png" "$here/sheet.png"
fi
