# shellcheck shell=bash
# What the tests of engines share.

Log() { printf '%(%T)T %s\n' -1 "$*"; }

Fail() {
  Log "FAILED: $*"
  exit 1
}

# Prints what it runs and what that says, and fails with it.
Run() {
  Log "\$ $(basename -- "$1") ${*:2}"
  "$@" 2>&1 | sed 's/^/    /'
}

# Need COMMAND...: ends the test as skipped if one is not installed, and says so.
Need() {
  local command missing=()
  for command in "$@"; do
    command -v "$command" > /dev/null || missing+=("$command")
  done
  ((${#missing[@]})) || return 0
  Log "SKIPPED, nothing was tested: ${missing[*]} not installed (purposes slurm and engines of cmake/setup.sh)"
  exit 77
}

# WaitFor SECONDS COMMAND...: succeeds as soon as the command does. The seconds end what hangs.
WaitFor() {
  local end=$((SECONDS + $1))
  until "${@:2}"; do
    ((SECONDS < end)) || return 1
    sleep 0.02
  done
}

# HasRows FILE: a part file that a shard is writing rows to.
HasRows() { (($(wc -l 2> /dev/null < "$1" || echo 0) > 1)); }
