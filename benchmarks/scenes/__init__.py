"""Scenes from files beside other renderers: three.js (npm, in Chromium), Filament (PyPI: filly) and cubecam.

`python -m benchmarks.scenes` draws a GLB of 16 materials with each and prints how far they are apart;
`python -m benchmarks.scenes.foreign` draws files that other people made, from packages of npm and PyPI.
"""
