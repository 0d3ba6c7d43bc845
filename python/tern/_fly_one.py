"""The process of one flight of a campaign: python3 -m tern._fly_one --scenario FILE --charge WORD --seed N --folder DIR."""
import argparse
import sys

from . import _tern

EXIT_CANNOT_WRITE = 3


def main() -> int:
    parser = argparse.ArgumentParser(prog="python3 -m tern._fly_one")
    parser.add_argument("--scenario", required=True)
    parser.add_argument("--charge", required=True)
    parser.add_argument("--set", action="append", default=[], dest="settings")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--folder", required=True)
    options = parser.parse_args()
    try:
        print(_tern.fly_one(options.scenario, options.settings, options.charge, options.seed, options.folder), end="")
    except OSError as error:
        print(error, file=sys.stderr)
        return EXIT_CANNOT_WRITE
    except ValueError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
