# For tools/test-debian and tools/package, which source this file: bare Debian systems in folders of build/debian.
# Takes root and debootstrap. The packages come from where this machine's apt has Debian's, or from
# VKDOSE_DEBIAN_MIRROR, through the proxy that apt uses.

tool=$(basename "$0")
folder=$root/build/debian
running=
trap '[ -z "$running" ] || kill -KILL "$running"' EXIT
trap 'exit 130' HUP INT TERM

if [ "$(id -u)" -ne 0 ]; then
    echo "tools/$tool: only root can make and enter a chroot; call it as root or with sudo" >&2
    exit 1
fi
if ! command -v debootstrap >/dev/null; then
    echo "tools/$tool: debootstrap is not installed (apt-get install debootstrap)" >&2
    exit 1
fi
mkdir -p "$folder"

# bare_system SUITE NAME: makes $folder/NAME, a bare system of Debian SUITE. $folder/SUITE-base, of which it is a copy,
# is made once.
bare_system() {
    local suite=$1 bare=$folder/$2 base=$folder/$1-base log=$folder/$1-debootstrap.log mirror proxy=
    mirror=${VKDOSE_DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' 'Label: Debian' 2>/dev/null | sed -n 1p)}
    mirror=${mirror:-http://deb.debian.org/debian}
    eval "$(apt-config shell proxy Acquire::http::Proxy)"
    if [ ! -d "$base" ]; then
        echo "debootstrap $suite from $mirror"
        rm -rf --one-file-system "$base.part"
        if ! http_proxy=$proxy debootstrap --variant=minbase "$suite" "$base.part" "$mirror" >"$log" 2>&1; then
            tail -n 20 "$log" >&2
            echo "tools/$tool: debootstrap failed; its whole log is $log" >&2
            exit 1
        fi
        mv "$base.part" "$base"
    fi
    rm -rf --one-file-system "$bare"
    cp -a "$base" "$bare"
    cp -L /etc/resolv.conf "$bare/etc/resolv.conf"
    echo "deb $mirror $suite main" >"$bare/etc/apt/sources.list"
    [ -z "$proxy" ] || echo "Acquire::http::Proxy \"$proxy\";" >"$bare/etc/apt/apt.conf.d/proxy"
}

# inside NAME LOG COMMAND: runs the shell command in the system $folder/NAME; what it says goes into LOG. Mounts and
# processes live in namespaces of their own, and go when unshare goes, however this ends.
inside() {
    local status=0
    unshare --mount --pid --fork --kill-child bash -c '
        mount -t proc proc "$0/proc" && mount -t sysfs -o ro sysfs "$0/sys" && mount --rbind /dev "$0/dev" &&
        exec chroot "$0" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"' \
        "$folder/$1" bash -c "$3" >"$2" 2>&1 &
    running=$!
    wait "$running" || status=$?
    running=
    return "$status"
}
