"""Headless EGL for the peers, by versioned library names: a system without -dev packages has no others."""

LIBRARIES = {"libgl": "libEGL.so.1", "libegl": "libEGL.so.1"}
