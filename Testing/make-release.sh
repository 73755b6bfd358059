#!/bin/bash
# Makes a release of the tag that HEAD has: the source archive, the packages of each Debian, each built and
# tested on a fresh machine (run-on.sh: hours), and their checksums.
# Usage: make-release.sh [options] [RELEASE...]     RELEASE: bookworm, trixie, sid; all three if none is named
#   --only-source   the archive and its checksum alone
#   --output DIR    in place of build/release/<tag>; a folder that is not there yet, or is empty
#   --run-on "..."  options for run-on.sh, as --cache
# The tag is v and the version that CMakeLists.txt has, and CHANGELOG.md has a section of it with its date.
# Nothing is uploaded. The exit code is 0 only if all of it was made.
set -euo pipefail
called_from="$PWD"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "make-release.sh: $1" >&2
  exit "${2:-1}"
}
only_source=no
output=""
run_on=()
releases=()
while [ $# -gt 0 ]; do
  case "$1" in
    --only-source) only_source=yes ;;
    --output | --run-on)
      [ -n "${2:-}" ] || fail "$1 needs a value" 2
      if [ "$1" = --output ]; then
        output=$(cd "$called_from" && realpath -m -- "$2")
      else
        read -r -a run_on <<<"$2"
      fi
      shift
      ;;
    bookworm | trixie | sid) releases+=("$1") ;;
    *)
      echo "make-release.sh: unknown argument '$1'" >&2
      sed -n '4,9s/^# //p' Testing/make-release.sh >&2
      exit 2
      ;;
  esac
  shift
done
[ ${#releases[@]} -gt 0 ] || releases=(bookworm trixie sid)
[ "$only_source" = no ] || releases=()

[ "$(git rev-parse --show-toplevel 2>/dev/null)" = "$PWD" ] || fail "this is no git clone, so it has no tag"
changes=$(git status --porcelain)
[ -z "$changes" ] || fail "the tree is not clean; commit or remove what differs from HEAD:"$'\n'"$changes"
version=$(sed -n 's/^ *VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt | head -n 1)
tag="v$version"
tags=$(git tag --points-at HEAD | paste -sd ' ')
[[ " $tags " == *" $tag "* ]] ||
  fail "HEAD has ${tags:+the tag $tags, but }not the tag $tag of the version in CMakeLists.txt: git tag -a $tag"
# What is called 0.2 there is 0.2.0.
grep -qE "^## ${version%.0} \([0-9]{4}-[0-9]{2}-[0-9]{2}\)$" CHANGELOG.md ||
  fail "CHANGELOG.md has no section '## ${version%.0} (year-month-day)'"
[ -n "$output" ] || output="$PWD/build/release/$tag"
[ -z "$(ls -A "$output" 2>/dev/null)" ] || fail "there is something in $output already"
mkdir -p "$output"

name="vtksvo-$version"
git archive --prefix="$name/" "$tag" | gzip -9n >"$output/$name.tar.gz"
for release in "${releases[@]}"; do
  Testing/run-on.sh "${run_on[@]}" --folder "$PWD/build/fresh" "$release" || fail "$release failed; there is no release"
  cp "build/fresh/$release.packages"/*.deb "$output"
done
# Hidden until all of it is there: a folder without checksums is no release.
(cd "$output" && sha256sum -- * >.sums && mv .sums SHA256SUMS && sha256sum --quiet -c SHA256SUMS)
echo "Release $tag in $output:"
ls -sh "$output"
