"""run.py CHECK ROOT: one check of this folder over the project. Status 0: clean; 1: problems; 77: skipped."""

import importlib
import sys

import project


def main():
    check, root = sys.argv[1:]
    try:
        found = importlib.import_module(check).problems(root)
    except project.Skipped as reason:
        print(f"{check}: skipped: {reason}")
        return 77
    print("\n".join(found) if found else f"{check}: clean")
    return 1 if found else 0


sys.exit(main())
