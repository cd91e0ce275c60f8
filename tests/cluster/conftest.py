"""Importing distributed takes half a second: only `make test-cluster`, which runs these tests, collects them."""


def pytest_ignore_collect(config):
    """Leave the folder out of all other runs."""
    return None if config.option.markexpr == "cluster" else True
