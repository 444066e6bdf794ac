"""The command: ``lyrefit`` of an installed wheel, or ``python3 -m lyrefit``."""

import sys

from . import _lyrefit


def main():
    """Run the command with the arguments of the process and end the process with its exit code."""
    if not hasattr(_lyrefit, "_run_command"):
        sys.exit("error: this build of the module is without the command; wheels have it (cmake/wheel.sh)")
    sys.exit(_lyrefit._run_command(["lyrefit", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
