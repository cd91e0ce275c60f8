"""ktx-parse reads KTX2 files of cubecam: header, descriptor, keys and each texel."""

import numpy as np
import pytest

import cubecam as cc
from tests.interop.directions import sky_cube

pytestmark = pytest.mark.interop

CODE = """
import { read, write } from "ktx-parse";
import { readFileSync, writeFileSync } from "node:fs";
const file = read(readFileSync(process.argv[2]));
const levels = file.levels.map((level) => Buffer.from(level.levelData).toString("base64"));
writeFileSync(process.argv[3], write(file)); // and back
const { levels: _, ...rest } = file;
const plain = (key, value) => (ArrayBuffer.isView(value) ? [...value] : value);
console.log(JSON.stringify({ ...rest, data: levels }, plain));
"""


@pytest.mark.parametrize("half", [False, True])
def test_a_cube_with_levels(half, tmp_path, node):
    import base64

    cube = sky_cube().prefilter(levels=4)
    path, again = tmp_path / "a.ktx2", tmp_path / "b.ktx2"
    cube.save(path, half=half)
    told = node(CODE, path, again)
    assert told["vkFormat"] == (97 if half else 109)
    assert (told["pixelWidth"], told["faceCount"], told["typeSize"]) == (64, 6, 2 if half else 4)
    assert told["keyValue"]["KTXorientation"] == "rd"
    block = told["dataFormatDescriptor"][0]
    assert block["transferFunction"] == 1
    assert block["bytesPlane"][0] == (8 if half else 16)
    assert [s["channelType"] & 15 for s in block["samples"]] == [0, 1, 2, 15]
    dtype = "<f2" if half else "<f4"
    for k, (text, level) in enumerate(zip(told["data"], cube.levels, strict=True)):
        texels = np.frombuffer(base64.b64decode(text), dtype).reshape(6, 64 >> k, 64 >> k, 4)
        want = cc.CubeMap(level).resize(64 >> k).faces
        np.testing.assert_allclose(texels[..., :3], want, rtol=1e-3 if half else 1e-6)
    assert cc.load_cubemap(again) == cc.load_cubemap(path)  # what ktx-parse writes is read
