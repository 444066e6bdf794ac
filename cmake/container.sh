#!/bin/sh
# What cmake/Containerfile runs, and cmake/bare.sh on a system with as little in it.
#   container.sh build             makes the packages of the sources that it lies in, in build/packages
#   container.sh install FOLDER    installs the command of FOLDER, with what it needs and no more
set -eu
export DEBIAN_FRONTEND=noninteractive
case ${1:-} in
  build)
    apt-get -qq update
    "$(dirname -- "$0")/packages.sh"
    ;;
  install)
    apt-get -qq update
    apt-get -qq install -y --no-install-recommends "$2"/liblyrefit[0-9]*.deb "$2"/lyrefit_*.deb
    rm -rf /var/lib/apt/lists/*
    ;;
  *)
    echo "usage: container.sh build | install FOLDER" >&2
    exit 2
    ;;
esac
