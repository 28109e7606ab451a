#!/usr/bin/env bash
# What relightable packs take and lose: bytes, and errors under several suns beside packs that were baked under each.
# usage: tests/bench/figures/relighting.sh <directory of the programs> <output directory> MESH...
# Writes relighting.md into the output directory. What that has is kept: an interrupted run goes on. Needs jq. SUNS, azimuth
# and elevation in degrees; CAMERAS (8), between the baked directions; SIZE (640x360).
set -euo pipefail
if (($# < 3)); then
  sed -n '3p' "$0" | sed 's/^# //' >&2
  exit 2
fi
bin=$(cd "$1" && pwd) out=$2
shift 2
mkdir -p "$out"
suns=${SUNS:-0,7 138,30} cameras=${CAMERAS:-8} size=${SIZE:-640x360}
farcell() { "$bin/farcell-$1" "${@:2}"; }

# The mesh's pack with these options, under this name.
pack() {
  [[ -s $out/$2.far ]] || farcell build "$1" -o "$out/$2.far" "${@:3}" --quiet >/dev/null
}

# auto and A of the relightable pack of that model, beside those of the pack baked under that sun.
evaluate() {
  local report=$out/$1.report$2
  [[ -s $report/report.json ]] ||
    farcell evaluate "$out/$1.relightable.far" --sun="$2" --against "baked=$out/$1.baked$2.far" --auto-cameras "$cameras" \
      --size "$size" --frames 1 --renderers auto,A,auto@baked,A@baked --quiet -o "$report" >/dev/null
  jq -r '.summary | [."auto@baked", .auto, ."A@baked", .A]
    | map(.ratioToFull1spp * 1000 | round / 1000 | tostring) | join(" | ")' "$report/report.json"
}

# Geometric means of columns of ratios, one line a sun.
means() {
  awk -F' [|] ' '{ for (i = 1; i <= NF; ++i) sum[i] += log($i) }
    END { for (i = 1; i <= NF; ++i) printf "%s%.3f", (i > 1 ? " | " : ""), exp(sum[i] / NR); print "" }'
}

bytes() { stat -c %s "$out/$1.far"; }

table=$out/relighting.md
{
  echo "Bytes: of the whole pack. Ratios to full geometry at 1 sample: *auto* of a pack baked under the sun, and of the"
  echo "relightable one lit by it; the same of *A*, all impostors. $cameras cameras between the baked directions, $size."
  echo
  echo "| model | sun | auto, baked | auto, relit | A, baked | A, relit |"
  echo "|---|---|---|---|---|---|"
} >"$table.part"
sizes="
| model | baked, bytes | relightable | |
|---|---|---|---|"
for mesh in "$@"; do
  name=$(basename "${mesh%.*}")
  pack "$mesh" "$name.baked"
  pack "$mesh" "$name.relightable" --lighting relightable
  own=$(farcell info --json "$out/$name.baked.far" | jq -r '.settings.sun | map(tostring) | join(",")')
  ln -sf "$name.baked.far" "$out/$name.baked$own.far"
  echo "| $name | own | $(evaluate "$name" "$own") |" >>"$table.part"
  rows=
  for sun in $suns; do
    pack "$mesh" "$name.baked$sun" --sun="$sun"
    row=$(evaluate "$name" "$sun")
    echo "| $name | $sun | $row |" >>"$table.part"
    rows+="$row"$'\n'
  done
  echo "| $name | mean of the others | $(printf %s "$rows" | means) |" >>"$table.part"
  baked=$(bytes "$name.baked") relightable=$(bytes "$name.relightable")
  sizes+="
| $name | $baked | $relightable | + $(((relightable - baked) * 100 / baked)) % |"
done
echo "$sizes" >>"$table.part"
mv "$table.part" "$table"
cat "$table"
