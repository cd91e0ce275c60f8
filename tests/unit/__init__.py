"""Tests that need no OpenGL context."""
