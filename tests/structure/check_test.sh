#!/usr/bin/env bash
# Shows that check.sh finds what it is there for: each violation is made alone in a clean tree.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

fresh() {
  rm -rf "$tree"
  mkdir -p "$tree"/{cache/base,cache/schema,cache/pack,preprocess/read,preprocess/bake,preprocess/partition,runtime/gl,runtime/draw,tools/cli,tools/build,tools/render,tests/cache/base,datasets/city,shaders/shared}
  printf '#pragma once\nnamespace farcell {\nint base();\n}\n' >"$tree/cache/base/base.h"
  printf '#pragma once\n#include "cache/base/base.h"\n' >"$tree/cache/pack/pack.h"
  printf '#pragma once\n#include "cache/pack/pack.h"\n' >"$tree/preprocess/read/read.h"
  printf '#include "preprocess/read/read.h"\n#include <vector>\n' >"$tree/tools/build/main.cpp"
  printf '#ifndef A_H\n#define A_H\n#endif\n' >"$tree/shaders/shared/a.h"
  echo '#pragma once' >"$tree/runtime/gl/gl.h"
}

# expect <text of the finding> <file> <content>: the file, added to the clean tree, is found; nothing else is.
expect() {
  local found
  fresh
  mkdir -p "$(dirname "$tree/$2")"
  printf '%b' "$3" >"$tree/$2"
  found=$("$BASH" "$here/check.sh" "$tree") && found="(no finding)"
  if [[ $found != *"$1"* || $(wc -l <<<"$found") -ne 1 ]]; then
    printf 'expected one finding with "%s" for %s, found:\n%s\n' "$1" "$2" "$found"
    failures=$((failures + 1))
  fi
}

accept() {
  local found
  fresh
  mkdir -p "$(dirname "$tree/$1")"
  printf '%b' "$2" >"$tree/$1"
  if ! found=$("$BASH" "$here/check.sh" "$tree"); then
    printf 'expected no finding for %s, found:\n%s\n' "$1" "$found"
    failures=$((failures + 1))
  fi
}

longFunction() {
  printf 'int f() {\\n'
  printf '  f();\\n%.0s' $(seq "$1")
  printf '}\\n'
}

accept cache/base/a.cpp '#include "cache/base/base.h"\n'
accept tests/cache/base/a_test.cpp '#include <gtest/gtest.h>\n#include "tools/build/b.h"\n#include "runtime/gl/gl.h"\n'
accept preprocess/bake/a.cpp '#include "cache/schema/a.h"\n#include "hwy/highway.h"\n'
expect 'layer: cache/base/ may not include cache/schema/' cache/base/a.cpp '#include "cache/schema/b.h"\n'
expect 'cache/pack/a.h:2: layer: cache/pack/ may not include preprocess/read/' cache/pack/a.h '#pragma once\n#include "preprocess/read/read.h"\n'
expect 'layer: preprocess/read/ may not include runtime/gl/' preprocess/read/a.cpp '  #  include "runtime/gl/gl.h"\n'
expect 'layer: runtime/draw/ may not include preprocess/read/' runtime/draw/a.cpp '#include "preprocess/read/read.h"\n'
expect 'layer: preprocess/partition/ may not include preprocess/bake/' preprocess/partition/a.cpp '#include "preprocess/bake/b.h"\n'
expect 'layer: datasets/ may not include cache/pack/' datasets/city/a.cpp '#include "cache/pack/pack.h"\n'
expect 'layer: tools/build/ may not include tools/render/' tools/build/a.cpp '#include "tools/render/b.h"\n'
expect 'layer: tools/build/ may not include tests/' tools/build/a.cpp '#include "tests/support/b.h"\n'
expect 'not written from the root' cache/base/a.cpp '#include "base.h"\n'
expect 'dependency: Embree' preprocess/bake/a.cpp '#include <embree3/rtcore.h>\n'
expect 'dependency: OpenImageIO' cache/pack/a.cpp '#include <OpenImageIO/imageio.h>\n'
expect 'dependency: meshoptimizer' runtime/draw/a.cpp '#include <meshoptimizer.h>\n'
expect 'dependency: zlib' preprocess/read/a.cpp '#include <libdeflate.h>\n'
expect 'dependency: GLFW' runtime/gl/a.cpp '#include <GLFW/glfw3.h>\n'
expect 'dependency: libpng' tools/render/a.cpp '#include <png.h>\n'
expect 'dependency: EGL' tools/render/a.cpp '#include <epoxy/egl.h>\n'
expect 'dependency: nlohmann' preprocess/read/a.cpp '#include <nlohmann/json.hpp>\n'
expect 'layer: preprocess/read/scene/ may not include preprocess/read/' preprocess/read/scene/a.cpp '#include "preprocess/read/open_mesh.h"\n'
expect 'dependency: CLI11' cache/base/a.cpp '#include <CLI/CLI.hpp>\n'
expect 'size: 501 lines' cache/base/a.cpp "$(printf '//\\n%.0s' $(seq 501))"
expect 'size: a function of 61 lines' cache/base/a.cpp "$(longFunction 59)"
accept cache/base/a.cpp "$(longFunction 58)"
accept cache/base/a.cpp "// Long because the table is long.\\n$(longFunction 59)"
expect 'guard: neither' cache/base/a.h 'int a();\n'
expect 'namespace: `using namespace`' cache/base/a.h '#pragma once\nusing namespace std;\n'
accept cache/base/a.cpp 'using namespace std;\n'
expect 'name: a directory is named' cache/utils/a.txt ''
expect 'name: not a directory of the top level' docs/a.txt ''
expect 'download:' cmake/a.cmake 'include(FetchContent)\n'
expect 'download:' tools/a.sh 'pip install numpy\n'
expect 'layer: lies in no known layer' cache/other/a.cpp '\n'

if ((failures > 0)); then
  echo "$failures expectations of check.sh failed"
  exit 1
fi
