"""The program ``motion-rtl``, as ``python -m motion_rtl`` or ``motion-rtl``."""

import sys

from ._motion_rtl import _main


def main() -> None:
    """Run the command line and end the process with its exit code."""
    sys.exit(_main(["motion-rtl", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
