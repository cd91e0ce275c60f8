"""A scene for Mitsuba 3, made without Mitsuba: a dict for ``mitsuba.load_dict``, a file for ``mitsuba.load_file``."""
