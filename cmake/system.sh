# shellcheck shell=bash
# Sourced, after setup.sh, by the scripts beside it that need a Debian with nothing else: a minimal system in a temporary
# folder, which is gone at the end, however that comes. Root makes it.

((EUID == 0)) || Die "a system of its own is made by root"
# Mounts of its own, which go with the process.
if [[ -z ${LYREFIT_BARE:-} ]]; then
  InstallPackages bare
  LYREFIT_BARE=yes exec unshare --mount --propagation private "$BASH" "$0" "$@"
fi

system=$(mktemp -d /tmp/lyrefit-bare.XXXXXX)
Remove() {
  local mount
  for mount in "$system"/{proc,dev/pts,ccache}; do
    ! mountpoint -q "$mount" || umount --lazy "$mount" || return # what is mounted is not removed
  done
  rm -rf --one-file-system "$system"
}
trap Remove EXIT

Took() {
  printf '%6d s  %s\n' $((SECONDS - since)) "$*"
  since=$SECONDS
}
since=$SECONDS
InSystem() {
  chroot "$system" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 \
    CCACHE_DIR=/ccache "$@"
}
Apt() { InSystem apt-get -qq -o Acquire::Retries=3 "$@" > "$system/tmp/apt.log" 2>&1 || Die "apt-get $*: $(tail -n 5 "$system/tmp/apt.log")"; }
network=()
# AsUser SHELL OPTION...: a script on standard input, by a user who has nothing but a home.
AsUser() {
  "${network[@]}" chroot --userspec=user:user "$system" \
    env -i -C /home/user HOME=/home/user PATH=/usr/bin:/bin LC_ALL=C.UTF-8 TERM=dumb "$@"
}
# The same without a network.
AsUserAlone() {
  local network=(unshare --net)
  AsUser "$@"
}
Size() { du -sm --one-file-system "$system" | cut -f1; }

OWN_SUITE=$(. /etc/os-release && echo "$VERSION_CODENAME")
# MakeSystem SUITE: of a release of Debian, from where this machine has its own packages, instead of the one before it.
MakeSystem() {
  local mirror
  Remove
  mkdir -m 755 "$system"
  Say "A system of Debian $1 with nothing in it"
  mirror=$(apt-get indextargets --format "\$(REPO_URI)|\$(CODENAME)|\$(COMPONENT)" "Created-By: Packages" |
    sed -n "s/|$OWN_SUITE|main\$//p" | head -n 1)
  [[ $mirror ]] || Die "this machine's apt knows no Debian $OWN_SUITE"
  debootstrap --variant=minbase "$1" "$system" "$mirror" > "$system.log" 2>&1 || {
    tail -n 5 "$system.log"
    rm -f "$system.log"
    Die "debootstrap failed"
  }
  rm -f "$system.log"
  mount -t proc proc "$system/proc"
  mount -t devpts -o newinstance,ptmxmode=0666,mode=620,gid=5 devpts "$system/dev/pts"
  InSystem useradd --create-home user
  Apt update
  Took "made, $(Size) MB"
}

# PutSources SUITE FOLDER: those of the project, and a compiler's cache that stays, if this machine uses one.
PutSources() {
  local cache
  mkdir -p "$system$2"
  git -C "$LYREFIT_ROOT" ls-files -z | tar -C "$LYREFIT_ROOT" -c --null -T - | tar -x -C "$system$2"
  command -v ccache > /dev/null || return 0
  cache=$(ccache --get-config cache_dir)
  [[ $1 == "$OWN_SUITE" ]] || cache+=-$1 # other versions have a layout of their own
  Apt install -y --no-install-recommends ccache
  mkdir -p "$system/ccache" "$cache"
  mount --bind "$cache" "$system/ccache"
}
