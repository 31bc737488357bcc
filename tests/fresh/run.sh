#!/usr/bin/env bash
# Tries the project on a fresh machine: in a minimal installation of a distribution, with nothing but what the README
# says, by an ordinary user.
#
#   sudo bash tests/fresh/run.sh [OPTION…] DISTRIBUTION
#
# DISTRIBUTION is bookworm (Debian 12), trixie (Debian 13), noble (Ubuntu 24.04), or whatever else debootstrap or
# mmdebstrap knows. Needs root and one of these two (Debian: mmdebstrap), about 6 GB of disk, and an hour on two cores.
#
#   --commit REVISION   the commit to try; HEAD by default. Uncommitted changes are not tried.
#   --mirror URL        the distribution's archive
#   --steps "NAME…"     only these steps, of: quickstart tests command pip package
#   --work FOLDER       make the installation there and keep it; a later run with the same folder reuses it, so that a
#                       failure can be looked at and a fix tried quickly. Such a run is no longer a fresh machine.
#   --ccache FOLDER     share this compiler cache with the installation; ada becomes the owner of its files
#
# The user is called ada, may use sudo, has no UTF-8 locale and keeps the clone in a folder with a space in its name.
# tests/fresh/steps.sh is what she does. The last line printed is a row for the table in tests/README.md. The exit status
# is 0 if every step passed, 1 if one failed, 2 for wrong arguments.
set -euo pipefail

say() { printf '%s\n' "$*" >&2; }
fail() {
    say "tests/fresh/run.sh: $*"
    exit 2
}

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
revision=HEAD mirror='' steps='' work='' cache='' distribution=''
while [ $# -gt 0 ]; do
    case $1 in
        --commit | --mirror | --steps | --work | --ccache)
            [ $# -ge 2 ] || fail "$1 needs a value"
            case $1 in
                --commit) revision=$2 ;;
                --mirror) mirror=$2 ;;
                --steps) steps=$2 ;;
                --work) work=$2 ;;
                --ccache) cache=$2 ;;
            esac
            shift
            ;;
        -h | --help)
            sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
            exit 0
            ;;
        -*) fail "unknown option \"$1\"; --help lists them" ;;
        *)
            [ -z "$distribution" ] || fail "more than one distribution: \"$distribution\" and \"$1\""
            distribution=$1
            ;;
    esac
    shift
done
[ "$distribution" ] || fail "which distribution? bookworm, trixie, noble, …"
[ "$(id -u)" -eq 0 ] || fail "making a root filesystem needs root: sudo bash tests/fresh/run.sh $distribution"
commit=$(git -C "$repository" rev-parse --short --verify "$revision^{commit}") || fail "no commit \"$revision\""

fresh=yes
if [ "$work" ]; then
    mkdir -p "$work"
    work=$(cd "$work" && pwd -P)
else
    work=$(mktemp -d "${TMPDIR:-/tmp}/phasetree-fresh.XXXXXX")
    trap 'rm -rf --one-file-system "$work"' EXIT
fi
root=$work/root

if [ -e "$root/etc/os-release" ]; then
    fresh=
else
    say "Installing a minimal $distribution in $root …"
    if [ -z "$mirror" ]; then
        case $distribution in
            noble | jammy | plucky | questing) mirror=http://archive.ubuntu.com/ubuntu ;;
            *) mirror=http://deb.debian.org/debian ;;
        esac
    fi
    components=main
    case $mirror in *ubuntu*) components=main,universe ;; esac
    # What a person has before the first command: a way to become root, and a way to get the clone.
    given=sudo,git,ca-certificates
    if command -v mmdebstrap >/dev/null; then
        mmdebstrap --quiet --variant=minbase --components="$components" --include="$given" "$distribution" "$root" "$mirror"
    elif command -v debootstrap >/dev/null; then
        debootstrap --variant=minbase --components="$components" --include="$given" "$distribution" "$root" "$mirror" >&2
    else
        fail "neither mmdebstrap nor debootstrap is installed"
    fi
    chroot "$root" useradd --create-home --shell /bin/bash ada
    printf 'ada ALL=(ALL) NOPASSWD: ALL\n' >"$root/etc/sudoers.d/ada"
    printf '127.0.0.1 localhost %s\n' "$(hostname)" >"$root/etc/hosts"
fi
cp --dereference /etc/resolv.conf "$root/etc/resolv.conf"

git -C "$repository" bundle create --quiet "$root/home/ada/phasetree.bundle" HEAD "$commit" 2>/dev/null ||
    git -C "$repository" bundle create --quiet "$root/home/ada/phasetree.bundle" HEAD
install -m 644 "$repository/tests/fresh/steps.sh" "$root/home/ada/steps.sh"
chroot "$root" chown ada: /home/ada/phasetree.bundle

# A mount and a process namespace of its own: whatever the steps leave running or mounted ends with them.
inside='
    set -e
    root=$1 cache=$2 commit=$3 steps=$4
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    if [ "$cache" ]; then
        mkdir -p "$cache" "$root/home/ada/.cache/ccache"
        mount --bind "$cache" "$root/home/ada/.cache/ccache"
        chroot "$root" chown ada: /home/ada/.cache
        chroot "$root" chown -R ada: /home/ada/.cache/ccache
    fi
    exec chroot "$root" su ada -s /bin/bash -c "
        cd && exec env -i HOME=/home/ada USER=ada LOGNAME=ada TERM=dumb PATH=/usr/local/bin:/usr/bin:/bin \
            bash /home/ada/steps.sh $commit $steps"
'
begin=$(date +%s)
status=0
unshare --mount --pid --fork --kill-child bash -c "$inside" - "$root" "$cache" "$commit" "$steps" || status=1
duration=$(($(date +%s) - begin))

name=$(. "$root/etc/os-release" && printf '%s' "$PRETTY_NAME")
result=$(cat "$root/home/ada/result" 2>/dev/null || printf 'no step was run')
[ "$fresh" ] || result="$result (not a fresh root)"
printf '| %s | %s | %s | %d min | %s |\n' "$(date +%F)" "$name" "$commit" $(((duration + 30) / 60)) "$result"
exit "$status"
