"""Puts a model into a picture: a camera that sees all of it, light, a ground that catches its shadow.

`cubecam render` and `cubecam view` use it. Nothing here is public.
"""
