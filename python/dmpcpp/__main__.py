"""`python -m dmpcpp`."""

from dmpcpp.cli import main

if __name__ == "__main__":
    main()
