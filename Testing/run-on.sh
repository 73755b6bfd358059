#!/bin/bash
# Runs the two commands of the README on a fresh Debian: a root file system with nothing installed,
# made for this, that holds a clone of this repository's HEAD. Then makes the Debian packages there,
# installs them in a second fresh root, which has no compiler, and renders with them.
# Usage: run-on.sh [options] RELEASE          RELEASE: bookworm, trixie, sid
#   --only demo|tests|packages  one of the three; packages needs a root that was kept after the tests
#   --keep         leaves the roots for the next call with --keep, which takes the new HEAD into them
#   --folder DIR   where roots, packages and logs lie, in place of build/fresh
#   --cache DIR    a compiler cache to be used and kept. Without it everything is compiled, as on a
#                  fresh machine
#   --mirror URL   in place of the one that mmdebstrap takes by itself
#   --no-install   never installs on this machine: names what is missing and stops
# The exit code is 0 only if everything succeeded. Without --keep the roots are removed, those that
# were kept before as well. What is not committed is not tested.
#
# Runs as root, or as a user who has a range of ids in /etc/subuid. Everything is mounted in
# namespaces of the commands' own, which the kernel clears away with their last process.
set -euo pipefail
called_from="$PWD"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "run-on.sh: $1" >&2
  exit "${2:-1}"
}
step() { printf '\n== %s (%s)\n' "$1" "$(date +%T)"; }
usage() { sed -n '5,15s/^# //p' Testing/run-on.sh; }
absolute() { (cd "$called_from" && realpath -m -- "$1"); }

release=""
steps="demo tests packages"
keep=no
folder="$PWD/build/fresh"
cache=""
mirror=""
check_only=()
while [ $# -gt 0 ]; do
  case "$1" in
    --only | --folder | --cache | --mirror)
      [ -n "${2:-}" ] || fail "$1 needs a value" 2
      case "$1 $2" in
        "--only demo" | "--only tests" | "--only packages") steps="$2" ;;
        --only*) fail "--only takes demo, tests or packages, not '$2'" 2 ;;
        --folder*) folder=$(absolute "$2") ;;
        --cache*) cache=$(absolute "$2") ;;
        --mirror*) mirror="$2" ;;
      esac
      shift
      ;;
    --keep) keep=yes ;;
    --no-install) check_only=(--no-install) ;;
    -h | --help)
      usage
      exit 0
      ;;
    -*)
      echo "run-on.sh: unknown argument '$1'" >&2
      usage >&2
      exit 2
      ;;
    *)
      [ -z "$release" ] || fail "one release at a time, not '$release' and '$1'" 2
      release="$1"
      ;;
  esac
  shift
done
wants() { [[ " $steps " == *" $1 "* ]]; }
case "$release" in
  bookworm | trixie | sid) ;;
  "")
    usage >&2
    exit 2
    ;;
  *) fail "unknown release '$release' (bookworm, trixie, sid)" 2 ;;
esac

# What CMake is told on this release beyond what it is told anywhere.
arguments="${VTKSVO_CMAKE_ARGUMENTS:-}"
[ "$release" != sid ] || arguments+=" -DVTKSVO_DEPRECATIONS_ARE_ERRORS=ON"

step "Packages of this machine"
groups=(fresh)
[ "$(id -u)" -eq 0 ] || groups+=(user)
CMake/install-packages.sh "${check_only[@]}" "${groups[@]}"
head=$(git rev-parse --short HEAD) || fail "this is no git clone, so there is no HEAD to test"
changes=$(git status --porcelain | wc -l)
echo "Tested is HEAD, $head.$([ "$changes" -eq 0 ] || echo " $changes files differ from it: not tested.")"

# A user becomes root of a namespace in which the range of /etc/subuid makes up the other users.
unshare=(unshare --mount --pid --fork --kill-child --mount-proc)
if [ "$(id -u)" -ne 0 ]; then
  unshare+=(--map-root-user --map-auto)
  "${unshare[@]}" true ||
    fail "no user namespace: run this as root, or give $(id -un) a range in /etc/subuid and /etc/subgid"
fi

# Runs in the background and waits, so that a signal ends this script at once; what ran is killed with
# its namespace in clean_up.
running=""
isolated() {
  local result=0
  "${unshare[@]}" "$@" 9>&- &
  running=$!
  wait "$running" || result=$?
  running=""
  return "$result"
}
# Removes only a folder that this script made.
remove() {
  [ -e "$1/made-by-run-on" ] || return 0
  "${unshare[@]}" rm -rf --one-file-system "$1"
}
clean_up() {
  trap - EXIT INT TERM HUP
  if [ -n "$running" ]; then
    kill -KILL "$running" 2>/dev/null || true
    wait "$running" 2>/dev/null || true
  fi
  if [ "$keep" = no ]; then
    step "Removing the root"
    remove "$place"
  fi
}

place="$folder/$release"
root="$place/root"
log="$folder/$release.log"
packages="$folder/$release.packages"
mkdir -p "$folder" ${cache:+"$cache"}
exec 9>"$folder/$release.lock"
flock -n 9 || fail "another run-on.sh is at work in $place"
[ ! -e "$place" ] || [ -e "$place/made-by-run-on" ] || fail "$place is not a folder that this script made"
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
[ "$keep" = yes ] && [ -e "$root" ] || remove "$place"
mkdir -p "$place"
touch "$place/made-by-run-on"
: >"$log"

# A minimal Debian in the folder $1. It reaches the archive as this machine does: by the same proxies,
# with the same trust in dates.
settings=()
while read -r setting; do
  settings+=(--aptopt="$setting")
done < <(apt-config dump 2>/dev/null | grep -E '^Acquire::(https?::Proxy|Check-Valid-Until|Check-Date)')
make_root() {
  isolated rm -rf --one-file-system "$1.part"
  # A root that is thrown away need not be safe from a loss of power.
  isolated mmdebstrap --quiet --mode=root --variant=minbase --dpkgopt=force-unsafe-io "${settings[@]}" \
    "$release" "$1.part" ${mirror:+"$mirror"} || fail "mmdebstrap could not make $release"
  # What the installer of a real machine writes.
  isolated sh -c 'echo "127.0.0.1 localhost $(uname -n)" >"$1/etc/hosts"' hosts "$1.part"
  mv "$1.part" "$1"
}
# in_root FOLDER COMMAND...: with the devices and the name server of this machine, and nothing else of it.
environment=(HOME=/srv PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8)
for name in http_proxy https_proxy no_proxy; do
  [ -z "${!name:-}" ] || environment+=("$name=${!name}")
done
in_root() {
  isolated bash -c '
    set -e
    root=$1
    cache=$2
    shift 2
    mount --rbind /dev "$root/dev"
    mount --rbind /sys "$root/sys"
    mount -t proc proc "$root/proc"
    if [ -n "$cache" ]; then
      mkdir -p "$root/srv/.cache/ccache"
      mount --bind "$cache" "$root/srv/.cache/ccache"
    fi
    cat /etc/resolv.conf >"$root/etc/resolv.conf"
    exec chroot "$root" env -i "$@"' in_root "$1" "$cache" "${environment[@]}" "${@:2}"
}

if [ ! -e "$root" ]; then
  step "A fresh $release in $root"
  make_root "$root"
fi

step "Clone of $head"
git bundle create -q "$place/head.bundle" HEAD
isolated bash -c '
  set -e
  git -c init.defaultBranch=main init -q "$2"
  cd "$2"
  git fetch -q "$1" HEAD
  git checkout -q -f --detach FETCH_HEAD' clone "$place/head.bundle" "$root/srv/vtkSVO"

# run ROOT NAME COMMAND...: output goes to the terminal and into the log.
result=0
times=""
run() {
  local where="$1" name="$2" code=0 start=$SECONDS
  shift 2
  exec 8> >(exec tee -a "$log")
  local tee=$!
  step "$release: $name" >&8
  # Not the first process of its namespace: that one is spared signals, which xvfb-run waits for.
  in_root "$where" VTKSVO_CMAKE_ARGUMENTS="$arguments" \
    bash -c '"$@"; exit $?' run "$@" >&8 2>&1 || code=$?
  exec 8>&-
  wait "$tee"
  local seconds=$((SECONDS - start)) said=succeeded
  if [ "$code" -ne 0 ]; then
    said="FAILED ($code)"
    result=1
  fi
  times+=$(printf '  %-24s %3d:%02d minutes  %s' "$name" $((seconds / 60)) $((seconds % 60)) "$said")$'\n'
  return "$code"
}
if wants demo; then
  run "$root" ./Examples/run-demo.sh bash -c 'cd /srv/vtkSVO && ./Examples/run-demo.sh' || true
fi
if wants tests; then
  run "$root" ./Testing/run-tests.sh bash -c 'cd /srv/vtkSVO && ./Testing/run-tests.sh' || true
fi
if wants packages && run "$root" "packages made" /srv/vtkSVO/Testing/Packages/make.sh; then
  rm -rf "$packages"
  isolated cp -r "$root/srv/vtkSVO/build/packages" "$packages"
  users="$place/users"
  isolated rm -rf --one-file-system "$users"
  step "A fresh $release in $users"
  make_root "$users"
  isolated cp -r "$packages" "$users/srv/packages"
  isolated cp -r "$root/srv/vtkSVO/Testing" "$users/srv/Testing"
  run "$users" "packages used" /srv/Testing/Packages/use.sh /srv/packages || true
fi

step "Result of $head on $release"
version() { in_root "$root" dpkg-query -W -f='${source:Upstream-Version}' "$1" 2>/dev/null || echo "not installed"; }
echo "Debian $(in_root "$root" cat /etc/debian_version), VTK $(version libvtk9-dev)," \
  "ParaView $(version paraview)"
printf '%s' "$times"
# From ctest's own lines. It counts a skipped test as passed.
awk '
  /^Test project / { tree = $3; sub(".*/vtkSVO/", "", tree); skipped = 0 }
  /\*\*\*Skipped/ { ++skipped }
  /% tests passed, [0-9]+ tests failed out of/ {
    printf "  %-24s %d passed, %d failed, %d skipped\n", tree, $NF - $4 - skipped, $4, skipped
  }' "$log"
[ ! -e "$packages" ] || ls -sh "$packages"
echo "Log: $log"
[ "$keep" = no ] || echo "Root: $root"
exit "$result"
