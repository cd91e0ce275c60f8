"""The test suite: tests of numpy only, of C++ against numpy, of the GPU against numpy, and of small pictures."""
