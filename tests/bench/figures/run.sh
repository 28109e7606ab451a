#!/usr/bin/env bash
# The figures of a release, on real models: builds, baker, frames, error against 64 samples of the full geometry.
# usage: tests/bench/figures/run.sh <directory of the programs> <directory of the models> <output directory>
# The models: linz-west.ply (or .ply.xz) and nefertiti.obj. The cameras lie on spirals around each model, whatever its
# baked directions; distances in diameters of the bounding sphere, from its surface. Results: results.md beside this.
set -euo pipefail
if (($# != 3)); then
  sed -n '3p' "$0" | sed 's/^# //' >&2
  exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "$1" && pwd) models=$(cd "$2" && pwd)
mkdir -p "$3"
cd "$3"

[[ -f $models/linz-west.ply ]] && linz=$models/linz-west.ply || linz=$PWD/linz-west.ply
[[ -f $linz ]] || xz -dkc "$models/linz-west.ply.xz" >"$linz"

echo "== build: report as JSON in <model>.build.json"
"$bin/farcell" build "$linz" -o linz-west.far --json >linz-west.build.json
"$bin/farcell" build "$models/nefertiti.obj" -o nefertiti.far --json >nefertiti.build.json
grep -hE '"(total|peakRssBytes|pack)"' linz-west.build.json nefertiti.build.json

echo "== baker, CPU ms per 128^2 view"
"$bin/bench_baker" 11 | tee baker.csv

echo "== frames of an overview of linz-west, ms"
"$bin/bench_frame" linz-west.far 15 | tee frame.csv

for model in linz-west nefertiti; do
  echo "== error, $model"
  "$bin/farcell" evaluate $model.far --cameras "$here/$model.cameras.json" --frames 3 \
    --renderers full-1spp,full-4spp,full-16spp,flat,A,auto -o "$model.report"
done
