"""Headless EGL for the peers, by versioned library names, the only ones on a system without -dev packages."""

LIBRARIES = {"libgl": "libEGL.so.1", "libegl": "libEGL.so.1"}
