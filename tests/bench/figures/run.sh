#!/usr/bin/env bash
# The figures of impostors against full geometry, mesh hierarchy, the paper's impostors and octahedral ones, on real models.
# usage: tests/bench/figures/run.sh <directory of the programs> <directory of the models> <output directory> [MODEL...]
# MODEL: statue-6m, linz-west, city, statue-25m; default: all. The models directory has <MODEL>.ply; city is generated, and
# <MODEL>.far, where it is there, is not built again. What the output directory has is kept: an interrupted run goes on, and
# figures.md is made of the reports that are there. Needs jq. CAMERAS (16), FRAMES (3), PATH_FRAMES (60), PATH_SIZE
# (640x360): less of them is faster.
set -euo pipefail
if (($# < 3)); then
  sed -n '3p' "$0" | sed 's/^# //' >&2
  exit 2
fi
bin=$(cd "$1" && pwd) models=$(cd "$2" && pwd)
mkdir -p "$3"
cd "$3"
shift 3
(($# > 0)) || set -- statue-6m linz-west city statue-25m
cameras=${CAMERAS:-16} frames=${FRAMES:-3} path_frames=${PATH_FRAMES:-60} path_size=${PATH_SIZE:-640x360}
farcell() { "$bin/farcell-$1" "${@:2}" --progress none; }

mesh_of() {
  local mesh=$models/$1.ply
  if [[ $1 == city && ! -s $mesh ]]; then
    mesh=$PWD/city.ply
    [[ -s $mesh ]] || farcell generate city --triangles 2M --seed 1 -o "$mesh" >&2
  fi
  echo "$mesh"
}

pack_of() {
  local pack=$models/$1.far
  if [[ ! -s $pack ]]; then
    pack=$PWD/$1.far
    [[ -s $pack ]] || farcell build "$(mesh_of "$1")" -o "$pack" >&2
  fi
  echo "$pack"
}

# As the 2010 paper has it: 320 views from face centres, 1 sample a texel, all leaves at one level. Of the levels and sizes
# of images, those whose pack is nearest in bytes: more texels as long as it is the smaller one, then a level more.
paper_of() {
  local pack=$PWD/$1.paper.far aim size best=
  [[ -s $pack ]] && { echo "$pack"; return; }
  aim=$(stat -c %s "$2")
  for settings in 3:32 3:64 4:32 4:64 5:32; do
    farcell build "$(mesh_of "$1")" -o "$PWD/$1.try.far" --views 320 --samples 1 --fixed-level "${settings%:*}" \
      --image-size "${settings#*:}" >&2
    size=$(stat -c %s "$1.try.far")
    local off=$((size > aim ? size * 1000 / aim : aim * 1000 / size))
    echo "$1 paper $settings: $size bytes, pack $aim" >&2
    if [[ -z $best || $off -lt $best ]]; then best=$off && mv "$1.try.far" "$pack"; fi
    ((size > aim)) && break
  done
  rm -f "$1.try.far"
  echo "$pack"
}

# Full geometry, the baselines and ours from cameras between the baked directions, and along paths.
measure() {
  local model=$1 pack paper
  local -a paths=(--path orbit --path flyby)
  [[ $model == statue-* ]] || paths+=(--path street)
  pack=$(pack_of "$model")
  paper=$(paper_of "$model" "$pack")
  [[ -s $model.cameras/report.json ]] ||
    farcell evaluate "$pack" --auto-cameras "$cameras" --frames "$frames" --against paper="$paper" \
      --renderers auto,auto-B,lod,flat@paper,octahedral,lod-as-auto --sweep mesh-pixels=1,4 -o "$model.cameras"
  [[ -s $model.paths/report.json ]] ||
    farcell evaluate "$pack" "${paths[@]}" --path-frames "$path_frames" --size "$path_size" --reference-samples 16 \
      --renderers auto,auto-B,lod -o "$model.paths"
}

# The statue of 25 M triangles from 4 radii and from 1 radius from its sphere's surface.
measure_near() {
  local pack
  pack=$(pack_of statue-25m)
  [[ -s statue-25m.near/report.json ]] && return
  "$bin/farcell-info" "$pack" --json | jq '.model.bounds as $b | [range(3) | ($b.min[.] + $b.max[.]) / 2] as $c
    | ([range(3) | ($b.max[.] - $b.min[.]) / 2 | . * .] | add | sqrt) as $r
    | {cameras: [4, 1 | {name: "\(.) radii", position: [$c[0] + .6 * $r * (1 + .), $c[1] - .75 * $r * (1 + .),
        $c[2] + .28 * $r * (1 + .)], target: $c, up: [0, 0, 1], fovYDeg: 30}]}' >statue-25m.cameras.json
  farcell evaluate "$pack" --cameras statue-25m.cameras.json --frames "$frames" --reference-samples 16 \
    --renderers auto,auto-B,lod -o statue-25m.near
}

# Rows of tables, from reports.
cameras_table() {
  jq -r --arg model "$1" '
    def r(d): if . == null then "-" else . * pow(10; d) | round / pow(10; d) | tostring end;
    def pc(d): if . == null then "-" else . * 100 | r(d) end;
    .entries as $e | .summary | to_entries[] | .key as $name | .value as $s
    | [$e[] | select(.renderer == $name)] as $own
    | select($name | test("auto.*mesh-pixels=4") | not)
    | "| \($model) | \($name) | \($s.ratioToFull1spp | r(3)) | \($s.worstRatio | r(3)) | \($s.mostlyImpostors.ratioToFull1spp | r(3)) (\($s.mostlyImpostors.cameras)) | \($s.elsewhere.ratioToFull1spp | r(3)) (\($s.elsewhere.cameras)) | \([$own[].holeRate] | add / length | pc(3)) / \($s.worstHoleRate | pc(3)) | \([$own[].leakRate] | add / length | pc(2)) | \([$own[].coverageBias] | add / length | pc(2)) | \($s.medianFrameMs | r(1)) | \([$own[].cpuMs] | sort | .[length / 2 | floor] | r(1)) |"
  ' "$1.cameras/report.json"
}
equal_table() {
  jq -r --arg model "$1" '
    def r(d): if . == null then "-" else . * pow(10; d) | round / pow(10; d) | tostring end;
    .equal.kinds[] | "| \($model) | \(.kind) | \(.subjectBetter) of \(.cameras) | \(.errorRatio | r(3)) | \(.worstErrorRatio | r(3)) | \(.neverAsFast) | \(.speed | r(2)) | \(.leastSpeed | r(2)) | \(.neverAsGood) |"
  ' "$1.cameras/report.json"
}
paths_table() {
  jq -r --arg model "$1" '
    def r(d): if . == null then "-" else . * pow(10; d) | round / pow(10; d) | tostring end;
    .paths[] | .name as $path | ([.renderers[] | select(.renderer == "full-1spp")][0].summary.meanError) as $full
    | .renderers[] | .summary as $s
    | "| \($model) | \($path) | \(.renderer) | \($s.meanError / $full | r(3)) | \($s.meanFlicker | r(3)) | \($s.flickerToFull4spp | r(3)) | \($s.p99Flicker | r(3)) | \($s.switchFrames) of \($s.frames) | \($s.flickerAtSwitches | r(3)) | \($s.flickerElsewhere | r(3)) | \($s.worstPopToReference | r(2)) | \($s.medianMs | r(1)) |"
  ' "$1.paths/report.json"
}
near_table() {
  jq -r '.entries[] | "| \(.camera) | \(.renderer) | \(.psnr * 100 | round / 100) | \(.cpuMs | round) | \(.frameMs.median | round) | \(.triangles) | \(.impostors) | \(.ratioToFull1spp * 1000 | round / 1000) |"' \
    statue-25m.near/report.json
}
bytes_line() {
  jq -r --arg model "$1" '"- \($model): the pack \(.pack.bytes / 1e6 | round) MB, the paper'"'"'s \(.against.paper.bytes / 1e6 | round) MB (\(.against.paper.bytesToPack * 1000 | round / 10) %, views of \(.against.paper.imageSize)^2); frames of the octahedral impostor: \([.entries[] | select(.renderer == "octahedral")][0].settings.frameEdge)^2 texels."' \
    "$1.cameras/report.json"
}

write_figures() {
  local report model
  echo "Cameras: \`--auto-cameras $cameras\`, between the baked directions at .25 to 8 diameters, 1280x720, reference of 64 samples."
  echo "Ratio: geometric mean of paperError over that of full geometry at one sample. Frame times: medians, wall and CPU ms."
  echo
  echo "| model | renderer | ratio | worst | impostorShare >= .8 | elsewhere | holes %, mean / worst | leaks % | bias % | frame ms | CPU ms |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|"
  for report in *.cameras/report.json; do [[ -s $report ]] && cameras_table "${report%.cameras/*}"; done
  printf '\nPacks and memory of the baselines:\n\n'
  for report in *.cameras/report.json; do [[ -s $report ]] && bytes_line "${report%.cameras/*}"; done
  printf '\n## auto at equal time and at equal error\n\n'
  echo "Each kind along the front of its settings, interpolated. Ratio: auto's error over the kind's in auto's time; faster: the kind's"
  echo "time for auto's error over auto's."
  echo
  echo "| model | against | less error in its time | ratio | worst | never as fast | times faster | least | never as good |"
  echo "|---|---|---|---|---|---|---|---|---|"
  for report in *.cameras/report.json; do [[ -s $report ]] && equal_table "${report%.cameras/*}"; done
  printf '\n## Paths\n\n'
  echo "$path_frames frames of $path_size, reference of 16 samples; an orbit turns half a degree a frame. Error: over that of full-1spp. Pop:"
  echo "the largest flicker of a frame with switches over the reference's own mean change."
  echo
  echo "| model | path | renderer | error | flicker | to full-4spp | p99 | switches in | flicker there | elsewhere | worst pop | frame ms |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
  for report in *.paths/report.json; do [[ -s $report ]] && paths_table "${report%.paths/*}"; done
  if [[ -s statue-25m.near/report.json ]]; then
    printf '\n## Statue of 25 M triangles, FOV 30, against 16 samples\n\n'
    echo "| camera | renderer | PSNR dB | CPU ms | frame ms | triangles | impostors | ratio |"
    echo "|---|---|---|---|---|---|---|---|"
    near_table
  fi
}

for model; do
  if [[ $model == statue-25m ]]; then measure_near; else measure "$model"; fi
  write_figures >figures.md
done
