"""The test suite: numpy only -> C++ against numpy -> GPU against numpy -> small reference images."""
