#!/usr/bin/env bash
# Installs a package of farcell with apt in a minimal Debian system made for it, and uses it there: help, manual pages
# and from a city to a picture and a report. Nothing of this machine is in that system; it is gone afterwards.
# usage (as root): tests/package/clean_root.sh <farcell_*.deb> [picture.png]   The picture drawn there is copied out.
# Needs the packages mmdebstrap and what this machine's own package sources hold. Takes about two minutes.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if (($# < 1 || $# > 2)) || [[ ! -s $1 ]]; then
  echo "usage: clean_root.sh <farcell_*.deb> [picture.png]" >&2
  exit 2
fi
picture=${2:-/dev/null}
version=$(dpkg-deb -f "$1" Version)

# The distribution's sources of this machine, of which the small system is made too.
sources=$(apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' \
  'Created-By: Packages' 'Origin: Debian' | sort -u)
[[ -n $sources ]] || { echo "clean_root.sh: no Debian sources; run apt-get update" >&2; exit 1; }
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")

# What is run inside: $version is the package's.
check=$(mktemp)
trap 'rm -f "$check"' EXIT
cat >"$check" <<'END'
set -eux
test ! -e /usr/bin/c++
[ "$(farcell --version)" = "farcell $version" ]
farcell --help
for page in farcell farcell-generate farcell-build farcell-batch farcell-repack farcell-info farcell-verify farcell-render \
  farcell-view farcell-extract farcell-evaluate; do
  man -w "$page"
done
MANPAGER=cat man farcell-build | grep -- '--leaf-triangles'
mkdir /root/work
LIBGL_ALWAYS_SOFTWARE=1 sh /root/pipeline.sh farcell /root/work
apt-get -q -y remove farcell
test ! -e /usr/bin/farcell-build
END

mmdebstrap --quiet --mode=root --variant=apt --include=man-db --format=null \
  --customize-hook="upload '$1' /root/farcell.deb" \
  --customize-hook="upload '$here/pipeline.sh' /root/pipeline.sh" \
  --customize-hook="upload '$check' /root/check.sh" \
  --customize-hook='chroot "$1" apt-get -q -y install /root/farcell.deb' \
  --customize-hook="chroot \"\$1\" env version='$version' sh /root/check.sh" \
  --customize-hook="download /root/work/city.png '$picture'" \
  "$suite" /dev/null - <<<"$sources"
echo "clean_root.sh: farcell $version was installed, used and removed ($SECONDS s)"
