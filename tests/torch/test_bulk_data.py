"""docs/howto/bulk_data.md: its lines of torch."""

from typing import Any

import numpy as np
import pytest
import torch

from tests.documents import fenced, python_blocks

pytestmark = pytest.mark.torch

NAME = "docs/howto/bulk_data.md"


def test_the_lines_of_torch(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scope: dict[str, Any] = {}
    (writes,) = (code for code in python_blocks(NAME) if '"captures.zarr", mode="w"' in code)
    (reads,) = (code for code in fenced(NAME, "py") if "import torch" in code)
    for code in (writes, reads):
        exec(compile(code, NAME, "exec"), scope)
    cube, light = scope["cube"], scope["light"]
    assert light.data_ptr() == cube.faces.__array_interface__["data"][0]
    assert (tuple(light.shape), light.dtype) == ((6, 32, 32, 4), torch.float16)
    assert tuple(scope["images"].shape) == (6, 4, 32, 32)
    np.testing.assert_array_equal(scope["distance"].numpy(), cube.distance)
    data = scope["Captures"]("captures.zarr")
    assert len(data) == 8
    assert torch.equal(data[7]["color"], light)
