#!/usr/bin/env bash
# Installs from the distribution's own packages what building, testing and running farcell needs, and only what is
# missing. Made for Debian 12; the names are those of Ubuntu too, whose releases may bring other versions (Embree 3 is
# needed). Quick and silent when nothing is missing.
set -euo pipefail

packages=(
  # to build
  g++ cmake ninja-build pkg-config
  # cache: messages, results, checksums, coding; vectors of all layers
  libfmt-dev libexpected-dev libxxhash-dev libglm-dev libdeflate-dev zlib1g-dev libmeshoptimizer-dev
  # preprocess: SIMD
  libhwy-dev
  # runtime: OpenGL by EGL without a window, and Mesa's software renderer where there is no GPU
  libepoxy-dev libegl-dev libegl-mesa0 libgl1-mesa-dri
  # tools: command line, JSON, pictures, the ray tracer of the reference
  libcli11-dev nlohmann-json3-dev libopenimageio-dev libembree-dev
  # tests and benchmarks; the coders that the 2010 paper's images are tried with
  libgtest-dev libbenchmark-dev libwebp-dev liblzma-dev
  # to unpack models that come compressed
  xz-utils
)

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
