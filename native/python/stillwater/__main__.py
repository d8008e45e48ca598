"""`python -m stillwater`."""

import sys


def main() -> int:
    """The command line. Answers the exit code: 0 done, 1 failed at work, 2 bad input."""
    from .command_line.main import own_standard_error, run

    own_standard_error()
    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
