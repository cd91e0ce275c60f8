"""A picture and its truth, for tests of comparisons."""

import numpy as np
import pytest

import cubecam as cc

TRUTH = np.random.default_rng(7).random((24, 32, 3))
PICTURE = np.clip(TRUTH + np.random.default_rng(8).normal(0, 0.1, TRUTH.shape), 0, 1)

try:
    import flip_evaluator
except ImportError:
    flip_evaluator = None
HAS_FLIP = flip_evaluator is not None
needs_flip = pytest.mark.skipif(not HAS_FLIP, reason="flip-evaluator is not installed")


def compare(picture, truth, mask=None, **options):
    return cc.truth.compare(picture, truth, mask, **{"flip": False} | options)
