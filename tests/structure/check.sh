#!/usr/bin/env bash
# Checks what the compiler does not: layer direction, heavy dependencies in their place, sizes, guards, no downloads.
# usage: check.sh <repository root>   Prints a line per finding ("file:line: rule: what"); exit 1 if there is any.
# Needs bash, find, sort and awk only.
set -euo pipefail
export LC_ALL=C
cd "${1:?usage: check.sh <repository root>}"

sources() {
  find . -path './build*' -prune -o -type f \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.glsl' -o -name '*.vert' -o -name '*.frag' -o -name '*.comp' \) -print |
    cut -c3- | sort
}
texts() {
  find . -path ./.git -prune -o -path './build*' -prune -o -type f \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.sh' -o -name '*.txt' -o -name '*.cmake' -o -name '*.html' -o -name '*.css' -o -name '*.js' -o -name '*.json' -o -name run \) -print |
    cut -c3- | sort
}

# A layer may include itself and lower ones. Where two stand side by side, `allowed` names what each may see.
layers() {
  sources | xargs -d '\n' -r awk '
    # The layer of a path: the longest prefix listed; its rank orders a chain, its chain keeps siblings apart.
    function layer(path,   i, best) {
      best = ""
      for (i = 1; i <= count; ++i)
        if (index(path, prefix[i]) == 1 && length(prefix[i]) > length(best)) best = prefix[i]
      return best
    }
    function add(path, chain, level) { prefix[++count] = path; chainOf[path] = chain; rank[path] = level }
    function mayInclude(from, to) {
      if (from == to) return 1
      if (rank[to] >= rank[from]) return 0
      # base: for all. datasets sees cache/base alone. preprocess and runtime never see each other.
      if (chainOf[from] == "datasets") return to == "cache/base/" || chainOf[to] == "datasets"
      if (chainOf[to] == "base" || chainOf[from] == "top") return 1
      return chainOf[from] == chainOf[to]
    }
    BEGIN {
      add("shaders/", "base", 0); add("cache/base/", "base", 1); add("cache/schema/", "base", 2)
      add("cache/pack/", "base", 3); add("cache/store/", "base", 4)
      # Models side by side, over what they share.
      add("datasets/ply/", "datasets", 5); add("datasets/random/", "datasets", 5); add("datasets/", "datasets", 6)
      add("preprocess/mesh/", "preprocess", 7); add("preprocess/texture/", "preprocess", 8)
      split("ply obj stl off gltf scene", formats, " ")
      for (i in formats) add("preprocess/read/" formats[i] "/", "preprocess", 9)
      add("preprocess/read/", "preprocess", 10); add("preprocess/partition/", "preprocess", 11)
      add("preprocess/lod/", "preprocess", 11); add("preprocess/bake/", "preprocess", 11)
      add("preprocess/choose/", "preprocess", 11); add("preprocess/atlas/", "preprocess", 12)
      add("preprocess/encode/", "preprocess", 14); add("preprocess/measure/", "preprocess", 15)
      add("preprocess/build/", "preprocess", 16)
      add("runtime/gl/", "runtime", 9)
      add("runtime/camera/", "runtime", 10); add("runtime/cost/", "runtime", 10)
      add("runtime/selection/", "runtime", 11)
      add("runtime/draw/", "runtime", 12); add("runtime/occlusion/", "runtime", 12)
      add("runtime/", "runtime", 13); add("runtime/calibration/", "runtime", 14)
      # What several programs share (tools/reference < cli, image, report < options) lies below the programs, which never
      # see each other.
      add("tools/reference/", "top", 19); add("tools/cli/", "top", 20); add("tools/image/", "top", 20)
      add("tools/report/", "top", 20); add("tools/options/", "top", 21)
      add("tools/build/program/", "top", 21)
      split("build batch repack info verify render evaluate generate extract view farcell", verbs, " ")
      for (i in verbs) add("tools/" verbs[i] "/", "top", 22)
      add("tests/", "top", 30)
    }
    FNR == 1 {
      from = layer(FILENAME)
      if (from == "") printf "%s:1: layer: lies in no known layer\n", FILENAME
    }
    /^[ \t]*#[ \t]*include[ \t]*"/ {
      split($0, quoted, "\"")
      if (quoted[2] ~ /^hwy\//) next  # the way Highway includes a file again for each target
      to = layer(quoted[2])
      if (to == "") printf "%s:%d: layer: include \"%s\" is not written from the root of the repository\n", FILENAME, FNR, quoted[2]
      else if (from != "" && !mayInclude(from, to))
        printf "%s:%d: layer: %s may not include %s (%s)\n", FILENAME, FNR, from, to, quoted[2]
    }'
}

# heavy <what> <regex of the header> <regex of the places allowed>: the include, and the link in CMake, only there.
heavy() {
  sources | xargs -d '\n' -r awk -v what="$1" -v header="$2" -v places="$3" '
    /^[ \t]*#[ \t]*include[ \t]*[<"]/ && $0 ~ header && FILENAME !~ places {
      printf "%s:%d: dependency: %s is not for this directory\n", FILENAME, FNR, what
    }'
}
dependencies() {
  heavy Embree '[<"]embree[0-9]*/' '^(tools/evaluate|tests)/'
  heavy OpenImageIO '[<"]OpenImageIO/' '^(preprocess/texture|tools/extract|tests/support)/'
  heavy meshoptimizer '[<"]meshoptimizer' '^(cache/pack|preprocess/lod|preprocess/read/gltf|tests)/'
  heavy stb '[<"]stb/' '^preprocess/atlas/'
  heavy OpenMesh '[<"]OpenMesh/' '^preprocess/lod/'
  heavy zlib '[<"](libdeflate|zlib)\.h' '^(cache/pack|tests)/'
  heavy 'WebP, LZMA' '[<"](webp/|lzma\.h)' '^tests/bench/'
  heavy xxHash '[<"]xxhash\.h' '^cache/base/'
  heavy tinygltf '[<"]tiny_gltf' '^(preprocess/read/gltf|tests)/'
  heavy draco '[<"]draco/' '^(preprocess/read/gltf|tests)/'
  heavy GLFW '[<"]GLFW/' '^runtime/gl/window/'
  heavy libpng '[<"]png\.h' '^tools/image/png\.cpp'
  heavy Highway '[<"]hwy/' '^(preprocess/bake|tests)/'
  heavy EGL '[<"](EGL/|epoxy/egl)' '^runtime/gl/'
  heavy OpenGL '[<"](epoxy/gl\.|GL/)' '^(runtime|tools/evaluate/baselines|tests/runtime|tests/bench)/'
  heavy nlohmann '[<"]nlohmann/' '^(preprocess/(read/(scene|gltf)|choose)|runtime/camera|tools|tests)/'
  heavy CLI11 '[<"]CLI/' '^(tools|tests/bench)/'
  heavy GoogleTest '[<"](gtest|gmock)/' '^tests/'
  heavy 'Google Benchmark' '[<"]benchmark/' '^tests/bench/'
}

# A line of a header or source at a time: guards, using, and what GLSL may be instead.
lines() {
  sources | xargs -d '\n' -r awk '
    function closeFile() {
      if (name ~ /\.h$/ && !guarded) printf "%s:1: guard: neither #pragma once nor #ifndef ... #define\n", name
      if (count > 500) printf "%s:%d: size: %d lines, at most 500\n", name, count, count
    }
    FNR == 1 { if (name != "") closeFile(); name = FILENAME; guarded = 0; macro = ""; count = 0 }
    { count = FNR }
    /^#pragma once/ || /^#if .*HWY_TARGET_TOGGLE/ { guarded = 1 }
    /^#ifndef / && macro == "" { macro = $2 }
    /^#define / && macro != "" && $2 == macro { guarded = 1 }
    /using namespace/ && name ~ /\.h$/ && name != "shaders/shared/portable.h" && $0 !~ /^[ \t]*\/\// {
      printf "%s:%d: namespace: `using namespace` in a header\n", name, FNR
    }
    END { if (name != "") closeFile() }'
}

# Functions start in column 0 (namespaces are not indented) and end with "}" there. Over 60 lines needs a comment
# "Long because ..." inside or just above; of all functions, 95 % have at most 40.
functions() {
  sources | { grep -E '\.cpp$' || true; } | xargs -d '\n' -r awk '
    function begins(text) {
      return text ~ /\{$/ && text !~ /^(namespace|struct|class|enum|union|extern|constexpr [A-Za-z:]+ k|const )/ && text ~ /\)[a-z &]*\{$/
    }
    FNR == 1 { start = 0; reason = -9; head = 0 }
    /Long because/ { reason = FNR }
    !start && /^[A-Za-z_].*\(/ { head = FNR }
    !start && ((/^[A-Za-z_]/ && begins($0)) || (/^    .*\)[a-z ]*\{$/ && head && FNR - head < 6)) { start = head ? head : FNR }
    /^}/ && start {
      size = FNR - start + 1
      ++total
      if (size > 40) ++long40
      if (size > 60 && reason < start - 3)
        printf "%s:%d: size: a function of %d lines; over 60 needs a comment \"Long because ...\"\n", FILENAME, start, size
      start = 0; head = 0
    }
    END { if (total >= 40 && long40 > total * 0.05) printf ".:1: size: %d of %d functions have more than 40 lines, at most 5 %%\n", long40, total }'
}

median() {
  sources | xargs -d '\n' -r awk 'FNR == 1 && NR > 1 { print last } { last = FNR } END { if (NR) print last }' | sort -n |
    awk '{ size[NR] = $1 }
      END { middle = size[int((NR + 1) / 2)]; if (middle > 150) printf ".:1: size: the median file has %d lines, at most 150\n", middle }'
}

names() {
  find . -path ./.git -prune -o -path "./build*" -prune -o -type d \( -name utils -o -name util -o -name common -o -name misc \) -print |
    awk '{ printf "%s:1: name: a directory is named for what it holds\n", substr($0, 3) }'
  find . -mindepth 1 -maxdepth 1 -type d ! -name '.*' | sort | awk '
    $0 !~ /^\.\/(cache|cmake|datasets|preprocess|runtime|shaders|tests|tools|build[^\/]*|demo-out)$/ {
      printf "%s:1: name: not a directory of the top level\n", substr($0, 3)
    }'
}

# Everything comes from the distribution's packages: nothing is fetched while building.
downloads() {
  texts | xargs -d '\n' -r awk '
    FILENAME ~ /^tests\/structure\// { next }
    /FetchContent|ExternalProject_Add|file\(DOWNLOAD|git clone|curl |wget |pip3? install|npm install|cargo install|conan |vcpkg / ||
    /(pypi\.org|npmjs\.(com|org)|crates\.io|conan\.io|repo1?\.maven|rubygems\.org|proxy\.golang\.org|deb\.debian\.org|archive\.ubuntu\.com)/ {
      printf "%s:%d: download: nothing but the package manager fetches anything\n", FILENAME, FNR
    }'
}

findings=$(layers; dependencies; lines; functions; median; names; downloads) || { echo "check.sh itself failed"; exit 2; }
if [[ -n $findings ]]; then
  printf '%s\n' "$findings"
  exit 1
fi
