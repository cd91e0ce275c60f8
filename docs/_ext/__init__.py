"""Extensions of Sphinx that build cubecam's site; `docs/conf.py` lists them.

They read sources and documents of the repository and run its examples. None of them needs a network.
"""
