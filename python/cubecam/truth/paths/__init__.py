"""Paths of light: what they meet, where they go on, and what they bring back."""
