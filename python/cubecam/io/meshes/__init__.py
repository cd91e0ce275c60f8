"""Mesh files: `load.py` has the public function, each other module reads one kind of file into parts."""
