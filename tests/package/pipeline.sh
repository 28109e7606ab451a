#!/bin/sh
# usage: pipeline.sh <farcell> <empty directory>: from nothing to a picture and a report, with the programs as installed.
set -eu
farcell=$1
cd "$2"
"$farcell" generate city --triangles 20k --seed 3 -o city.ply
"$farcell" build city.ply -o city.far --quiet
"$farcell" info city.far --json >info.json
"$farcell" verify city.far
"$farcell" render city.far --size 320x180 -o city.png
"$farcell" evaluate city.far --auto-cameras 2 --size 160x90 --reference-samples 16 --renderers flat,A,auto --frames 1 -o report
# The picture as a texture: the module that reads images is found.
printf 'newmtl picture\nmap_Kd city.png\n' >textured.mtl
printf 'mtllib textured.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl picture\nf 1/1 2/2 3/3\n' >textured.obj
"$farcell" build textured.obj -o textured.far --quiet --json >textured.json
grep -q '"read": 1' textured.json || { echo "pipeline: the texture was not read" >&2; cat textured.json >&2; exit 1; }
for file in city.png report/report.json report/report.csv; do
  [ -s "$file" ] || { echo "pipeline: $file is missing or empty" >&2; exit 1; }
done
