#!/usr/bin/env bash
# Shows that check.sh finds what it is there for: each violation is made in a file of its own of one small tree.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

make() {
  if [[ -e $tree/$1 ]]; then echo "check_test: two cases in $1" >&2; exit 2; fi
  local directory=$tree/${1%/*}
  [[ -d $directory ]] || mkdir -p "$directory"
  printf '%b' "$2" >"$tree/$1"
}

# expect <file> <text of the finding> <content>: the file has this finding and no other.
declare -A expected=()
expect() {
  make "$1" "$3"
  expected[$1]=$2
}

# accept <file> <content>: the file has no finding.
accept() { make "$1" "$2"; }

longFunction() {
  printf 'int f() {\\n'
  printf '  f();\\n%.0s' $(seq "$1")
  printf '}\\n'
}

# Clean files, which others may include.
accept cache/base/base.h '#pragma once\nnamespace farcell {\nint base();\n}\n'
accept cache/pack/pack.h '#pragma once\n#include "cache/base/base.h"\n'
accept preprocess/read/read.h '#pragma once\n#include "cache/pack/pack.h"\n'
accept tools/build/main.cpp '#include "preprocess/read/read.h"\n#include <vector>\n'
accept shaders/shared/a.h '#ifndef A_H\n#define A_H\n#endif\n'
accept runtime/gl/gl.h '#pragma once\n'

accept cache/base/a.cpp '#include "cache/base/base.h"\n'
accept tests/cache/base/a_test.cpp '#include <gtest/gtest.h>\n#include "tools/build/b.h"\n#include "runtime/gl/gl.h"\n'
accept preprocess/bake/a.cpp '#include "cache/schema/a.h"\n#include "hwy/highway.h"\n'
expect cache/base/b.cpp 'layer: cache/base/ may not include cache/schema/' '#include "cache/schema/b.h"\n'
expect cache/pack/a.h 'cache/pack/a.h:2: layer: cache/pack/ may not include preprocess/read/' '#pragma once\n#include "preprocess/read/read.h"\n'
expect preprocess/read/a.cpp 'layer: preprocess/read/ may not include runtime/gl/' '  #  include "runtime/gl/gl.h"\n'
expect runtime/draw/a.cpp 'layer: runtime/draw/ may not include preprocess/read/' '#include "preprocess/read/read.h"\n'
expect preprocess/partition/a.cpp 'layer: preprocess/partition/ may not include preprocess/bake/' '#include "preprocess/bake/b.h"\n'
expect datasets/city/a.cpp 'layer: datasets/ may not include cache/pack/' '#include "cache/pack/pack.h"\n'
expect tools/build/a.cpp 'layer: tools/build/ may not include tools/render/' '#include "tools/render/b.h"\n'
expect tools/build/b.cpp 'layer: tools/build/ may not include tests/' '#include "tests/support/b.h"\n'
expect cache/base/c.cpp 'not written from the root' '#include "base.h"\n'
expect preprocess/bake/b.cpp 'dependency: Embree' '#include <embree3/rtcore.h>\n'
expect cache/pack/a.cpp 'dependency: OpenImageIO' '#include <OpenImageIO/imageio.h>\n'
expect runtime/draw/b.cpp 'dependency: meshoptimizer' '#include <meshoptimizer.h>\n'
expect preprocess/read/b.cpp 'dependency: zlib' '#include <libdeflate.h>\n'
expect runtime/gl/a.cpp 'dependency: GLFW' '#include <GLFW/glfw3.h>\n'
expect tools/render/a.cpp 'dependency: libpng' '#include <png.h>\n'
expect tools/render/b.cpp 'dependency: EGL' '#include <epoxy/egl.h>\n'
expect preprocess/read/c.cpp 'dependency: nlohmann' '#include <nlohmann/json.hpp>\n'
expect preprocess/read/scene/a.cpp 'layer: preprocess/read/scene/ may not include preprocess/read/' '#include "preprocess/read/open_mesh.h"\n'
expect cache/base/d.cpp 'dependency: CLI11' '#include <CLI/CLI.hpp>\n'
expect cache/base/e.cpp 'size: 501 lines' "$(printf '//\\n%.0s' $(seq 501))"
expect cache/base/f.cpp 'size: a function of 61 lines' "$(longFunction 59)"
accept cache/base/g.cpp "$(longFunction 58)"
accept cache/base/h.cpp "// Long because the table is long.\\n$(longFunction 59)"
expect cache/base/a.h 'guard: neither' 'int a();\n'
expect cache/base/b.h 'namespace: `using namespace`' '#pragma once\nusing namespace std;\n'
accept cache/base/i.cpp 'using namespace std;\n'
expect cache/utils/a.txt 'name: a directory is named' ''
expect docs/a.txt 'name: not a directory of the top level' ''
expect cmake/a.cmake 'download:' 'include(FetchContent)\n'
expect tools/a.sh 'download:' 'pip install numpy\n'
expect cache/other/a.cpp 'layer: lies in no known layer' '\n'

failures=0
fail() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

findings=$("$BASH" "$here/check.sh" "$tree") && fail "expected exit 1"
# By the path that a finding begins with: a file, or the directory at fault.
declare -A found=()
while IFS= read -r line; do
  path=${line%%:*}
  for file in "${!expected[@]}"; do
    if [[ $file == "$path" || $file == "$path"/* ]]; then
      found[$file]+=$line$'\n'
      continue 2
    fi
  done
  fail "expected no finding, found: $line"
done <<<"$findings"
for file in "${!expected[@]}"; do
  lines=${found[$file]:-(no finding)$'\n'}
  if [[ $lines != *"${expected[$file]}"* || $lines == *$'\n'*$'\n' ]]; then
    fail "expected one finding with \"${expected[$file]}\" for $file, found:"$'\n'"${lines%$'\n'}"
  fi
done

if ((failures > 0)); then
  echo "$failures expectations of check.sh failed"
  exit 1
fi
