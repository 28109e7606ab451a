#!/usr/bin/env bash
# usage: install_test.sh <build directory> <source directory> <program>...
# Installs into a prefix and below DESTDIR, moves what came out of it elsewhere, and works with it there while the
# programs of the build are out of sight.
set -euo pipefail
build=$1 source=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
top=$(mktemp -d)
trap 'rm -rf "$top"' EXIT
fail() {
  echo "install_test: $*" >&2
  exit 1
}

cmake --install "$build" --prefix "$top/first" >/dev/null
DESTDIR="$top/second" cmake --install "$build" --prefix /opt/farcell >/dev/null
diff -r "$top/first" "$top/second/opt/farcell" || fail "prefix and DESTDIR differ"

expected=$(for program in "$@"; do
  printf '%s\n' "bin/$program" "share/man/man1/$program.1.gz" "share/bash-completion/completions/$program" \
    "share/zsh/site-functions/_$program" "share/fish/vendor_completions.d/$program.fish"
done; printf 'share/doc/farcell/%s\n' LICENSE README.md CHANGELOG.md; echo lib/farcell/modules/farcell-image-decoder.so)
diff <(sort <<<"$expected") <(cd "$top/first" && find . -type f | cut -c3- | sort) || fail "other files than expected"

# Nothing of where it was built, nor where it was installed first.
! grep -rlaF -e "$source" -e "$build" -e "$top/first" "$top/first" || fail "files name the tree they were made in"

mkdir "$top/work"
mv "$top/first" "$top/moved here"
if command -v man >/dev/null; then
  found=$(MANPATH="$top/moved here/share/man" man -w farcell-build)
  [[ $found == "$top/moved here/share/man/man1/farcell-build.1.gz" ]] || fail "man finds '$found'"
fi
# Where a mount of one's own is allowed, the programs of the build are hidden behind an empty one.
away=()
if unshare --mount --map-root-user true 2>/dev/null; then
  away=(unshare --mount --map-root-user sh -c 'mount -t tmpfs none "$0" && exec "$@"' "$build/bin")
fi
"${away[@]}" sh "$here/pipeline.sh" "$top/moved here/bin/farcell" "$top/work"
