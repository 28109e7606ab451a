#!/usr/bin/env bash
# usage: debian_test.sh <build directory> <version>
# Makes the Debian package and looks into it: fields, files, and what lintian says where it is installed.
set -euo pipefail
build=$1 version=$2
if ! command -v dpkg-deb >/dev/null || ! command -v dpkg-shlibdeps >/dev/null; then
  echo "debian_test: dpkg-dev is not installed"
  exit 77
fi
top=$(mktemp -d)
trap 'rm -rf "$top"' EXIT
fail() {
  echo "debian_test: $*" >&2
  exit 1
}

(cd "$build" && cpack -G DEB -B "$top/made" >"$top/log" 2>&1) || { cat "$top/log"; fail "cpack failed"; }
package=$top/made/farcell_${version}_$(dpkg --print-architecture).deb
[[ -s $package ]] || fail "no $package"
size=$(stat -c %s "$package")
((size < 20000000)) || fail "$size bytes"

field() { dpkg-deb -f "$package" "$1"; }
expect() { [[ $(field "$1") == $2 ]] || fail "$1: expected $2, found $(field "$1")"; }
expect Package farcell
expect Version "$version"
expect Section graphics
expect Maintainer '?* <?*@?*>'
expect Description '?*'
expect Homepage ''
for library in libc6 libstdc++6 libopenimageio libembree libepoxy0 libegl1 libgl1-mesa-dri; do
  expect Depends "*$library*"
done
[[ $(field Depends) != *mpi* ]] || fail "Depends: expected no MPI, found $(field Depends)"

dpkg-deb -x "$package" "$top/root"
[[ $("$top/root/usr/bin/farcell" --version) == "farcell $version" ]] || fail "another version"
for file in copyright changelog.gz README.md CHANGELOG.md; do
  [[ -s $top/root/usr/share/doc/farcell/$file ]] || fail "no $file"
done
gzip -dc "$top/root/usr/share/doc/farcell/changelog.gz" | head -n 1 | grep -qF "farcell ($version)" || fail "changelog"
for program in "$top"/root/usr/bin/*; do
  sections=$(readelf -SdW "$program")
  [[ $sections != *.symtab* ]] || fail "$program is not stripped"
  [[ $sections != *RPATH* && $sections != *RUNPATH* ]] || fail "$program looks for libraries elsewhere"
  [[ -s $top/root/usr/share/man/man1/${program##*/}.1.gz ]] || fail "$program has no manual page"
done

if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error,warning "$package" || fail "lintian"
fi
