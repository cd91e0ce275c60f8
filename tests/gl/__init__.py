"""Tests that draw: what the renderer hands out against the numpy oracle."""
