#!/usr/bin/env bash
# Installs from the distribution's own packages what building and running farcell needs, and only what is missing; with
# --tests also what the tests look through (a browser, a display, shells, MPI). Made for Debian 12; the names are those
# of Ubuntu too, whose releases may bring other versions (Embree 3 is needed). Quick and silent when nothing is missing.
# usage: tools/install-deps.sh [--tests]
set -euo pipefail

packages=(
  # to build
  g++ cmake ninja-build pkg-config
  # cache: messages, results, checksums, coding; vectors of all layers
  libfmt-dev libexpected-dev libxxhash-dev libglm-dev libdeflate-dev zlib1g-dev libmeshoptimizer-dev
  # preprocess: SIMD; glTF and what it may be compressed by
  libhwy-dev libtinygltf-dev libdraco-dev
  # preprocess: rectangles packed into atlases
  libstb-dev
  # preprocess: the slow simplifier
  libopenmesh-dev
  # runtime: OpenGL by EGL without a window, and Mesa's software renderer where there is no GPU
  libepoxy-dev libegl-dev libegl-mesa0 libgl1-mesa-dri
  # view: the window
  libglfw3-dev
  # tools: command line, JSON, pictures, the ray tracer of the reference
  libcli11-dev nlohmann-json3-dev libpng-dev libopenimageio-dev libembree-dev
  # tests and benchmarks, and the coders that a benchmark compares
  libgtest-dev libbenchmark-dev libwebp-dev libzstd-dev liblzma-dev
  # to unpack models that come compressed
  xz-utils
)
forTests=(
  # the browser that opens a report
  chromium
  # a display without a screen for the window, and a hand for its keys
  xvfb xdotool
  # readers of manual pages, shells that complete, and what looks into the Debian package
  man-db mandoc zsh fish dpkg-dev lintian
  # the tables that benchmarks make of reports
  jq
  # the optional farcell-build-mpi, and the mpirun that its test is run by
  libopenmpi-dev openmpi-bin
)

case ${1:-} in
  '') ;;
  --tests) packages+=("${forTests[@]}") ;;
  *)
    echo "usage: tools/install-deps.sh [--tests]" >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  {
    echo "install-deps: this is neither Debian nor Ubuntu (no apt-get); install by hand what these packages hold:"
    printf '  %s\n' "${packages[@]}"
  } >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
((${#missing[@]} > 0)) || exit 0

asRoot=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "install-deps: needs to be run as root (there is no sudo) to install: ${missing[*]}" >&2
    exit 1
  fi
  asRoot=(sudo)
fi
# sudo drops the environment: the setting goes with the command.
apt=("${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0)

echo "install-deps: installing ${missing[*]}" >&2
"${apt[@]}" update >&2 || echo "install-deps: the package lists could not be renewed; going on with those at hand" >&2
if ! "${apt[@]}" install --no-install-recommends "${missing[@]}" >&2 </dev/null; then
  echo "install-deps: could not install: ${missing[*]}" >&2
  exit 1
fi
