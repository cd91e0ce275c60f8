"""Tests that compare each program of the documents with numpy code written from the same document."""
