"""KTX 2.0 files (Khronos, "KTX File Format Specification", version 2.0, revision 4): cubemaps and pictures with levels.

`read` and `write` are all that other modules need. `texels` says how texels lie in memory, `header` reads and checks
all that comes before the texels, `packing` holds the two general compressions, `basis` what Basis Universal decodes,
and `blocks` the textures of GPUs that OpenImageIO decodes.
"""

from __future__ import annotations

from .header import MAGIC, read_header
from .reading import Ktx2, read
from .writing import write

__all__ = ["MAGIC", "Ktx2", "read", "read_header", "write"]
