"""docs/howto/bulk_data.md, engines.md, choose_a_gpu.md: arrays in stores, files for engines, devices."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
import zarr

import cubecam as cc
from tests.documents import text_of
from tests.howto.pages import printed


@pytest.mark.slow
@pytest.mark.skipif(sys.version_info < (3, 11), reason="zarr 3 needs Python 3.11")
class TestBulkData:
    NAME = "docs/howto/bulk_data.md"

    def test_the_batch_comes_back_from_its_store(self, pages):
        folder, scope = pages(self.NAME)
        batch, whole = scope["batch"], scope["whole"]
        np.testing.assert_array_equal(whole.faces, batch.faces)
        np.testing.assert_array_equal(whole.distance, batch.distance)
        np.testing.assert_array_equal(whole.positions, scope["places"])
        np.testing.assert_array_equal(scope["light"], batch.faces[10:20, :, ::2, ::2, :3])
        want = batch.faces[:, 2, :, :, :3].mean((1, 2), dtype=np.float64)
        np.testing.assert_allclose(scope["above"], want, rtol=1e-4)
        right = scope["places"][:, 0] > 0
        assert scope["near"].item() == batch.distance[right].min()
        group = zarr.open_group(folder / "probes.zarr", mode="r")
        attributes = {**group.attrs, **dict(group["color"].attrs), **dict(group["x"].attrs)}
        table = text_of(self.NAME).partition("| in the store |")[2].partition("\n\n")[0]
        for name in set(re.findall(r"`(\w+)`", "".join(table.splitlines()[-2:]))) - {"color"}:
            assert name in attributes, name
        assert {"color", "face", "channel", "x", "y", "z"} <= set(group)

    def test_captures_that_take_hours(self, pages):
        folder, scope = pages(self.NAME)
        stored = cc.open_batch(folder / "many.zarr")
        assert (len(stored), stored.faces.shards[0], stored.drawn) == (300, 50, None)
        mean = stored.faces[:].mean((1, 2, 3), dtype=np.float64)
        np.testing.assert_allclose(scope["means"], mean, rtol=1e-4)

    def test_the_store_holds_the_captures(self, pages):
        folder, scope = pages(self.NAME)
        store = zarr.open_group(folder / "captures.zarr", mode="r")
        cube = scope["cube"]  # the last one
        for name in ("color", "distance", "normal", "id"):
            array = store[name]
            assert isinstance(array, zarr.Array)
            want = cube.faces if name == "color" else cube.outputs[name]
            assert array.shape == (8, *want.shape)
            assert array.chunks == (1, *want.shape)
            np.testing.assert_array_equal(array[-1], want)
        ids = np.asarray(store["id"])
        assert (ids > 0).any(axis=(1, 2, 3)).all()
        assert np.isinf(np.asarray(store["distance"])[ids == 0]).all()

    def test_dlpack_gives_what_the_page_prints(self, pages):
        _, scope = pages(self.NAME)
        shared = scope["shared"]
        assert f"{shared.shape} {shared.dtype}\n" == printed(self.NAME)
        np.testing.assert_array_equal(shared, scope["cube"].faces)


@pytest.mark.slow
class TestEngines:
    NAME = "docs/howto/engines.md"

    def test_every_engine_has_its_row_and_its_files(self, pages):
        folder, _ = pages(self.NAME)
        rows = re.findall(r"^\| ([^|]+) \|[^|]*\| (`[^|]+) \|", text_of(self.NAME), re.MULTILINE)
        names = {"three.js": "three", "Babylon.js": "babylon", "Godot 4": "godot"}
        for title, files in rows:
            if title.startswith("your own"):
                continue
            engine = names.get(title, title.lower())
            written = {path.name for path in (folder / "light" / engine).iterdir()}
            named = set(re.findall(r"`([\w.]+)`", files))
            assert named <= written
            six = {f"{face}.hdr" for face in ("px", "nx", "py", "ny", "pz", "nz")}
            assert written - named - six == {"README.txt"}
        assert len(rows) == 7

    def test_levels_come_back_with_their_roughness(self, pages):
        folder, scope = pages(self.NAME)
        for name in ("levels.ktx2", "levels.dds"):
            again = cc.load_cubemap(folder / "light" / name)
            np.testing.assert_allclose(again.roughness, np.arange(6) / 5, atol=1e-6)
            assert [level.shape[1] for level in again.levels] == [64 >> k for k in range(6)]
        assert scope["light"].size == 64

    def test_a_panorama_has_the_size_that_the_page_says(self, pages):
        folder, scope = pages(self.NAME)
        path = folder / "light" / "three" / "environment.exr"
        assert cc.load_image(path).shape[:2] == (2 * 64, 4 * 64)
        assert 0.3 < path.stat().st_size / (2 * 64 * 4 * 64 * 6) < 1.1
        assert scope["cube"].faces.max() > 1  # light above what 8 bits hold


class TestChooseAGpu:
    NAME = "docs/howto/choose_a_gpu.md"

    def test_the_programs_draw_on_each_device(self, pages, capsys):
        _, scope = pages(self.NAME)
        with pytest.raises(LookupError, match="expected a device with the CUDA index 77"):
            scope["renderer_for"](77)
        assert [float(scope["draw"](k)) for k in (0, 7)] == [0, 7 / 8]

    @pytest.mark.parametrize("row", ["auto", "gpu", "software", "llvmpipe"])
    def test_the_table_has_the_words(self, row):
        assert f'| `"{row}"' in text_of(self.NAME) or f'`"{row}"` |' in text_of(self.NAME)

    def test_an_index_a_name_and_a_device_choose_the_same(self):
        first = cc.devices()[0]
        for device in (0, first, first.name[:8]):
            with cc.Renderer(device=device) as renderer:
                assert renderer.info.device.index == 0

    def test_the_variable_speaks_for_auto_alone(self):
        program = "import cubecam as cc; cc.Renderer(device='software').close(); cc.Renderer()"
        done = subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "CUBECAM_DEVICE": "97"},
            capture_output=True,
            text=True,
        )
        assert 'ContextError: no device "97" (from CUBECAM_DEVICE): expected' in done.stderr

    def test_the_messages_are_those_of_the_table(self):
        text = text_of(self.NAME)
        for device in (3_000, "no such card"):
            with pytest.raises(cc.ContextError) as raised:
                cc.Renderer(device=device)
            said = str(raised.value).replace("3000", "3").replace("no such card", "4090")
            shown = [
                re.escape(line)
                .replace(r"\.\.\.", ".*")
                .replace("expected\\ 0\\ to\\ 1", r"expected 0 to \d+")
                for line in re.findall(r"`ContextError: ([^`]+)`", text)
            ]
            assert any(re.fullmatch(line, said, re.DOTALL) for line in shown), said
