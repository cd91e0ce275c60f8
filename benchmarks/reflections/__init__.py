"""Reflections in three scenes, by each method, against exact rays: `python -m benchmarks.reflections`."""
