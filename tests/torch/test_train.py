"""docs/howto/train.md: shared memory, loaders with workers, seeds, processes that end, a loss that falls."""

import gc
import os
import pickle
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest
import torch
from torch.utils.data import DataLoader

import cubecam as cc
from tests.compare import assert_identical
from tests.documents import fenced, text_of
from tests.torch.conftest import NAME

pytestmark = pytest.mark.torch

PRINTED = fenced(NAME, "text")
SCENE_SIZE = 16


@pytest.fixture(scope="module")
def scene():
    made = cc.Scene(background=(0.1, 0.2, 0.3))
    made.add(cc.Mesh.sphere(0.5), cc.PhongMaterial(color="tomato"), position=(0, 0, -2))
    made.add(cc.PointLight((1, 2, 0)))
    return made


def address(array):
    return array.__array_interface__["data"][0]


def loader(items, workers, **options):
    if workers:
        options |= {"multiprocessing_context": "spawn", "timeout": 120}
    return DataLoader(items, batch_size=None, num_workers=workers, **options)


class TestSharedMemory:
    @pytest.mark.parametrize("pixels", ["rgba8", "rgba16f", "rgba32f"])
    def test_a_batch_and_its_outputs(self, renderer, scene, pixels):
        batch = renderer.capture_many(
            scene, np.eye(3), SCENE_SIZE, format=pixels, outputs=["distance", "id", "normal"]
        )
        for array, given in ((batch.faces, batch), *((a, a) for a in batch.outputs.values())):
            tensor = torch.from_dlpack(given)
            assert tensor.data_ptr() == address(array)
            assert tuple(tensor.shape) == array.shape
            assert_identical(tensor.numpy(), array)
        torch.from_dlpack(batch)[1] = 7
        assert (batch.faces[1] == 7).all()

    def test_one_cubemap_a_frame_and_frames(self, renderer, scene):
        camera = cc.PerspectiveCamera()
        frames = renderer.render_many(scene, [camera, camera], (24, 16))
        cubes = [renderer.capture(scene, size=SCENE_SIZE)]
        cubes += renderer.iter_captures(scene, np.eye(3), SCENE_SIZE)
        cubes.append(renderer.capture_async(scene, size=SCENE_SIZE).result())
        given = [(cube, cube.faces) for cube in cubes]
        given += [(frames, frames.color)]
        frame = renderer.render(scene, camera, (24, 16))
        for thing, array in [*given, (frame, frame.color)]:
            tensor = torch.from_dlpack(thing)
            assert tensor.data_ptr() == address(array)
            assert tensor.device.type == "cpu"
            assert_identical(tensor.numpy(), array)

    def test_channels_first_is_a_view(self, renderer, scene):
        from train import views

        batch = renderer.capture_many(scene, np.eye(3), SCENE_SIZE, outputs=["distance"])
        pictures, nearest = views(torch.from_dlpack(batch), torch.from_dlpack(batch.distance))
        assert pictures.data_ptr() == address(batch.faces)
        assert tuple(pictures.shape) == (18, 3, SCENE_SIZE, SCENE_SIZE)
        assert_identical(
            pictures.numpy(),
            batch.faces[..., :3].reshape(18, SCENE_SIZE, SCENE_SIZE, 3).transpose(0, 3, 1, 2),
        )
        want = np.log(batch.distance.reshape(18, -1).min(axis=1))
        np.testing.assert_allclose(nearest.numpy(), want, rtol=1e-6)

    def test_a_tensor_outlives_batch_and_renderer(self, scene):
        with cc.Renderer() as renderer:
            batch = renderer.capture_many(scene, np.eye(3), SCENE_SIZE)
            want = batch.faces.copy()
            tensor = torch.from_dlpack(batch)
            del batch
            again = renderer.capture_many(cc.Scene(background="white"), np.eye(3), SCENE_SIZE)
        del again
        gc.collect()
        assert_identical(tensor.numpy(), want)

    def test_the_page_prints_what_its_program_prints(self, folder):
        done = subprocess.run(
            [sys.executable, "address.py"], cwd=folder, capture_output=True, text=True, timeout=120
        )
        assert done.stdout == PRINTED[1], done.stderr


COUNT = 12


@pytest.fixture(scope="module")
def items():
    """What the data set gives in this process."""
    from captures import Captures

    drawn = Captures(COUNT)
    return [tuple(part.clone() for part in drawn[number]) for number in range(COUNT)]


class TestLoaders:
    def test_items_have_the_shapes_of_the_page(self, items):
        for colors, distance in items:
            assert f"colours {tuple(colors.shape)}" in text_of(NAME)
            assert f"distances {tuple(distance.shape)}" in text_of(NAME)
            assert (colors.dtype, distance.dtype) == (torch.float16, torch.float32)
            assert torch.isfinite(distance).all()
            assert distance.min() > 0
            assert colors.float().std() > 0.02

    @pytest.mark.parametrize("workers", [1, 2])
    def test_any_number_of_workers_gives_the_same_items(self, workers, items):
        from captures import Captures

        used = Captures(COUNT)
        used[0]  # a renderer of this process stays here
        found = list(loader(used, workers))
        assert len(found) == COUNT
        for got, want in zip(found, items, strict=True):
            for part, expected in zip(got, want, strict=True):
                assert torch.equal(part, expected)

    def test_a_shuffled_loader_repeats_by_its_seed(self, items):
        from captures import Captures

        def order(seed):
            generator = torch.Generator().manual_seed(seed)
            found = loader(Captures(COUNT), 0, shuffle=True, generator=generator)
            firsts = [float(colors.float().sum()) for colors, _ in found]
            want = [float(colors.float().sum()) for colors, _ in items]
            assert sorted(firsts) == sorted(want)
            return firsts

        assert order(3) == order(3) != order(4)

    def test_another_seed_has_other_rooms(self, items):
        from captures import Captures

        sums = {float(distance.sum()) for _, distance in items}
        assert len(sums) == COUNT
        assert float(Captures(1, seed=1)[0][1].sum()) not in sums

    def test_a_renderer_stays_where_it_was_made(self):
        from captures import Captures

        used = Captures(2)
        want = used[1]
        again = pickle.loads(pickle.dumps(used))
        assert used.renderer is not None
        assert again.renderer is None
        assert torch.equal(again[1][0], want[0])

    def test_workers_give_tensors_in_shared_memory(self):
        from captures import Captures

        here = Captures(1)[0]
        (there,) = loader(Captures(1), 1)
        assert all(part.is_shared() for part in there)
        assert not any(part.is_shared() for part in here)


def mapping_of(pointer):
    """The line of /proc/self/maps with this address."""
    for line in Path("/proc/self/maps").read_text().splitlines():
        first, last = (int(end, 16) for end in line.split()[0].split("-"))
        if first <= pointer < last:
            return line
    raise ValueError(f"expected an address that is mapped, got {pointer:#x}")


def test_a_pool_gives_memory_that_its_processes_wrote():
    from pooled import items
    from rooms import numbered_room

    with cc.Pool(workers=2) as pool:
        (colors, distance), (more, _) = items(pool, 128)
    assert tuple(colors.shape) == (64, 6, 32, 32, 4)
    assert "memfd:cubecam" in mapping_of(colors.data_ptr())
    assert "memfd:cubecam" in mapping_of(distance.data_ptr())
    with cc.Renderer() as renderer:
        options: dict[str, Any] = {"format": "rgba16f", "outputs": ["distance"]}
        for number, got in ((0, colors[0]), (63, colors[63]), (64, more[0])):
            want = renderer.capture(numbered_room(0, number), size=32, **options)
            assert_identical(got.numpy(), want.faces)


def ours():
    """The living processes that this one has started."""
    return {
        process.pid
        for process in psutil.Process().children(recursive=True)
        if process.status() != psutil.STATUS_ZOMBIE
        and "resource_tracker" not in " ".join(process.cmdline())
    }


@pytest.mark.parametrize("persistent", [False, True])
def test_no_process_stays_after_a_break(persistent):
    from captures import Captures

    before, shared = ours(), set(Path("/dev/shm").glob(f"torch_{os.getpid()}_*"))
    batches = loader(Captures(500), 2, persistent_workers=persistent)
    for number, _ in enumerate(batches):
        if number == 2:
            assert len(ours() - before) == 2
            break
    del batches, _
    gc.collect()
    until = time.monotonic() + 60
    while ours() - before and time.monotonic() < until:
        time.sleep(0.1)
    assert ours() - before == set()
    assert set(Path("/dev/shm").glob(f"torch_{os.getpid()}_*")) == shared


class TestTraining:
    def test_the_loss_falls(self):
        """Below half of what the best constant has: the variance of the logarithms."""
        from ahead import ahead
        from captures import Captures
        from train import train, views

        model, losses = train(ahead(Captures(160)))
        assert np.mean(losses[-30:]) < 0.6 * np.mean(losses[:30])
        unseen = Captures(8, seed=5)
        pictures, nearest = (
            torch.cat(parts)
            for parts in zip(*(views(*unseen[number]) for number in range(8)), strict=True)
        )
        with torch.no_grad():
            error = (model(pictures.float()) - nearest).square().mean()
        assert error < 0.7 * nearest.var()

    def test_a_thread_that_draws_ahead_gives_all_items_in_order(self):
        from ahead import ahead
        from captures import Captures

        want = [Captures(4)[number] for number in range(4)]
        for got, expected in zip(ahead(Captures(4)), want, strict=True):
            assert torch.equal(got[0], expected[0])
        items = ahead(Captures(400))
        next(items)
        items.close()  # ends the thread

    def test_training_repeats(self):
        from captures import Captures
        from train import train

        first, second = (train(Captures(4)[number] for number in range(4))[1] for _ in range(2))
        np.testing.assert_allclose(first, second, rtol=1e-3)

    def test_the_program_prints_what_the_page_says_and_draws(self, folder):
        done = subprocess.run(
            [sys.executable, "main.py"],
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=400,
            env={**os.environ, **dict(variables()), "MPLBACKEND": "agg"},
        )
        assert done.returncode == 0, done.stderr
        assert "Traceback" not in done.stderr
        pattern = r"loss of the first 50 rooms (\S+), of the last 50 (\S+)\n.* below (\S+)\n"
        found, said = (re.findall(pattern, text) for text in (done.stdout, PRINTED[0]))
        np.testing.assert_allclose(np.array(found, float), np.array(said, float), rtol=0.2)
        picture = cc.load_image(folder / "train.png")
        third = picture.shape[1] // 3
        for start in (0, third, 2 * third):
            assert picture[:, start : start + third].std() > 20

    def test_the_pool_prints_a_loss_that_falls(self, folder):
        done = subprocess.run(
            [sys.executable, "pooled.py"],
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=400,
            env={**os.environ, **dict(variables())},
        )
        assert done.returncode == 0, done.stderr
        pattern = r"loss of the first 10 batches (\S+), of the last 10 (\S+)\n"
        found, said = (re.findall(pattern, text) for text in (done.stdout, PRINTED[2]))
        np.testing.assert_allclose(np.array(found, float), np.array(said, float), rtol=0.2)


def variables():
    """The variables with which the page starts its program."""
    (line,) = fenced(NAME, "sh")
    *settings, python, program = line.split()
    assert (python, program) == ("python", "main.py")
    return [setting.split("=") for setting in settings]


def test_the_curve_is_that_of_cubecam():
    from srgb import to_srgb

    linear = np.linspace(0, 1, 500, dtype=np.float32).reshape(5, 100, 1).repeat(3, axis=2)
    want = cc.to_screen(linear, tonemap=None)
    got = np.rint(to_srgb(torch.from_numpy(linear)).numpy() * 255)
    assert np.abs(got - want[..., :3]).max() <= 1
    assert to_srgb(torch.tensor([-1.0, 2.0])).tolist() == pytest.approx([0, 1])
