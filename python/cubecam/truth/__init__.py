"""The same scene by exact rays, and how far a picture is from it: ``pip install "cubecam[truth]"``.

>>> import cubecam as cc, numpy as np
>>> truth = np.full((16, 16, 3), 0.5)
>>> round(cc.truth.compare(truth * 0.9, truth).relative_rmse, 6)
0.1
"""

from __future__ import annotations

from .compare import Comparison, compare

__all__ = ["Comparison", "compare"]
