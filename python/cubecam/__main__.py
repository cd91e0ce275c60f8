"""`python -m cubecam` is the command `cubecam`."""

from .cli import main

if __name__ == "__main__":
    main()
