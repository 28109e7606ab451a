#!/usr/bin/env bash
# From a fresh machine to pictures and an error report: installs what is missing, builds release, makes a procedural city,
# builds its pack, renders it and measures the pictures against the full geometry.
# usage: tools/demo.sh [--triangles 2M] [--out demo-out]
set -euo pipefail
# The caller's directory is where --out is relative to.
callerDirectory=$PWD
cd "$(dirname "$0")/.."

triangles=2M
out=$PWD/demo-out
usage() {
  echo "usage: tools/demo.sh [--triangles <count, e.g. 500k, 2M, 50M; default 2M>] [--out <directory; default demo-out>]"
}
while (($# > 0)); do
  case $1 in
    --triangles | --out)
      if (($# < 2)); then
        echo "tools/demo.sh: $1 needs a value" >&2
        exit 2
      fi
      if [[ $1 == --triangles ]]; then triangles=$2; else out=$2; fi
      shift 2
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      echo "tools/demo.sh: unknown option '$1'" >&2
      usage >&2
      exit 2
      ;;
  esac
done
[[ $out == /* ]] || out=$callerDirectory/$out

step() { printf '\n== %4d s: %s\n' "$SECONDS" "$*" >&2; }

step "installing what is missing"
tools/install-deps.sh

step "building farcell (release)"
programs=(farcell farcell-generate farcell-build farcell-info farcell-verify farcell-render farcell-view
  farcell-evaluate)
cmake --preset release >/dev/null
cmake --build --preset release --target "${programs[@]}" >&2
farcell=$PWD/build/release/bin/farcell

mkdir -p "$out"
cd "$out"
size=1280x720

step "a city of $triangles triangles"
"$farcell" generate city --triangles "$triangles" --seed 1 -o city.ply >&2
step "its pack"
"$farcell" build city.ply -o city.far --json >build.json
step "every byte of the pack"
"$farcell" verify city.far >&2

# The cameras follow the bounds of the city, which `info` tells, but for the one in the street: with seed 1, the avenue
# along the y axis lies at x = -8.3, its ground at z = 14.7, whatever the size of the city.
"$farcell" info city.far --json >info.json
tr -d ' \n' <info.json | grep -oE '"bounds":\{"min":\[[^]]*\],"max":\[[^]]*\]' | tr -c '0-9eE.+-' ' ' | awk '
  {
    n = 0
    for (i = 1; i <= NF; ++i) if ($i ~ /[0-9]/) v[n++] = $i
    if (n != 6) exit 1
    cx = (v[0] + v[3]) / 2; cy = (v[1] + v[4]) / 2; ground = v[2]
    dx = v[3] - v[0]; dy = v[4] - v[1]; r = sqrt(dx * dx + dy * dy) / 2
    shot = "    {\"name\": \"%s\", \"position\": [%.2f, %.2f, %.2f], \"target\": [%.2f, %.2f, %.2f], \"up\": [0, 0, 1], \"fovYDeg\": %g}%s\n"
    printf "{\"cameras\": [\n"
    printf shot, "overview", cx - 1.2 * r, cy - 1.45 * r, ground + r, cx - 0.12 * r, cy - 0.15 * r, ground, 40, ","
    printf shot, "quarter", cx - 0.75 * r, cy - 0.95 * r, ground + 0.5 * r, cx, cy, ground, 45, ","
    printf shot, "roofs", cx + 0.3 * r, cy - 0.35 * r, ground + 0.22 * r + 30, cx, cy + 0.1 * r, ground, 55, ","
    printf shot, "street", -8.3, -104.0, 16.9, -8.3, 100.0, 19.0, 60, ""
    printf "]}\n"
  }' >cameras.json || {
  echo "tools/demo.sh: found no bounds in $out/info.json" >&2
  exit 1
}

for camera in overview quarter roofs street; do
  step "picture: $camera"
  "$farcell" render city.far --camera cameras.json --camera-name "$camera" --size $size --repeat 3 -o "$camera.png"
done
step "the overview again with every triangle of the city, to compare"
"$farcell" render city.far --camera cameras.json --camera-name overview --size $size --repeat 3 --mode full -o overview-full.png

step "error of each way of drawing, against 64 samples of the full geometry"
"$farcell" evaluate city.far --cameras cameras.json --size 960x540 --renderers flat,A,auto --frames 2 -o report

step "done"
cat <<END
pictures: $out/{overview,quarter,roofs,street,overview-full}.png
report:   $out/report/index.html, which opens in a browser; report.json, report.csv
city:     $out/city.ply, its pack $out/city.far
walk:     $farcell view $out/city.far
more:     $farcell --help
END
