#!/usr/bin/env bash
# Builds packs of the statue at several sizes and leaf sizes and writes what it took as a table.
# usage: run.sh <directory of programs> <scan, e.g. nefertiti.obj> <output directory> [SIZE:LEAF ...]
# SIZE:LEAF, default: 1M:64k 6M:64k 25M:64k 25M:16k 100M:64k; 42 views, 4 samples, memory 2G. Meshes are removed after use.
set -euo pipefail
bin=$(realpath "${1:?directory of programs}") scan=$(realpath "${2:?scan}") out=$(realpath -m "${3:?output directory}")
shift 3
(($# > 0)) || set -- 1M:64k 6M:64k 25M:64k 25M:16k 100M:64k
mkdir -p "$out"
table=$out/table.md
{
  echo "| triangles | leaf | CPU s | us a triangle | wall s | peak MiB | views | impostors B/tri | geometry B/tri | pack MB |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
} >"$table"
for job in "$@"; do
  size=${job%:*} leaf=${job#*:}
  mesh=$out/statue-$size.ply
  [[ -s $mesh ]] || "$bin/farcell-generate" statue --from "$scan" --triangles "$size" -o "$mesh" --progress none
  report=$out/statue-$size-$leaf.json
  TIMEFORMAT='%U %S'
  { time "$bin/farcell-build" "$mesh" -o "$out/statue.far" --leaf-triangles "$leaf" --samples 4 --memory 2G \
    --progress none --json >"$report"; } 2>"$out/time"
  "$bin/farcell-verify" "$out/statue.far" --progress none >/dev/null
  read -r user system < <(tail -n 1 "$out/time")
  jq -r --argjson cpu "$user" --argjson sys "$system" --arg leaf "$leaf" '
    def round(d): . * d | round / d;
    .input.triangles as $n | ($cpu + $sys) as $c |
    "| \($n) | \($leaf) | \($c | round(10)) | \($c * 1e6 / $n | round(100)) | \(.seconds.total | round(10)) | \(.peakRssBytes / 1048576 | round(1)) | \(.views.kept) | \(.bytes.impostors / $n | round(100)) | \(.bytes.geometry / $n | round(100)) | \(.bytes.pack / 1e6 | round(1)) |"
  ' "$report" | tee -a "$table"
  rm -f "$out/statue.far" "$out/time"
  [[ $job == "${@: -1}" || "$*" != *"$size:"*"$size:"* ]] && rm -f "$mesh" || true
done
