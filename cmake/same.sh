#!/usr/bin/env bash
# Whether two builds of the command do the same: every verb, the commands of all pages, and every file of the data folders
# are run with both, and what they print and write, and their exit codes, are compared byte for byte. Durations are masked
# (cmake/same/running.py), and nothing else.
#   cmake/same.sh OLD NEW                two programs; at most 50 files of a folder, some twenty minutes on two cores
#   cmake/same.sh OLD NEW --full         all of them
#   cmake/same.sh OLD NEW --verb fit     the cases of one verb
#   cmake/same.sh OLD NEW --corpus       made cases instead: fits, families, tandems, cells, diagnoses and trends that chance
#                                        chose, the same always (cmake/same/corpus.py), some seven minutes of processor time;
#                                        --corpus fits tandems: of these kinds
#   cmake/same.sh OLD NEW --rounding 1e-9  differences by rounding told apart: a case whose texts differ only in numbers that
#                                        agree within this part of them is counted, and fails nothing (cmake/same/rounding.py)
#   cmake/same.sh --list                 the cases
#   cmake/same.sh PROGRAM --sanitized    one program, built with sanitizers, which must report nothing (cmake/sanitize.sh)
# --share 4 takes every fourth case, and --sweeps 2 at most two files of a folder.
# --data FOLDER (as often as wanted, or LYREFIT_FIELD_DATA) adds measurements; --allow FILE names differences that are meant,
# each with its reason. Exit code 1: a difference; 3: a case that both did not end within the limit.
set -euo pipefail
exec /usr/bin/python3 -B "$(dirname -- "${BASH_SOURCE[0]}")/same/same.py" "$@"
