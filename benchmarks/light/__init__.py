"""Metal spheres in photographs beside a path tracer's, and pictures beside another rasteriser's.

`python -m benchmarks.light.truth` renders the truth with Mitsuba 3 (packages of the extra `light`);
`python -m benchmarks.light.compare` renders the same with cubecam, and prints how far off it is;
`python -m benchmarks.light.pictures` draws spheres and meshes with cubecam and with Filament, side by side.
"""
