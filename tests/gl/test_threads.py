"""Renderers on several threads, one renderer shared by threads, scenes edited while they are drawn."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import room, smooth_environment
from tests.helpers import DEVICE


def mirror_scene(seed):
    scene = room().scene
    scene.environment = cc.CubeMap(smooth_environment(16))
    rng = np.random.default_rng(seed)
    ball = scene.add(
        cc.Mesh.icosphere(0.4), cc.MirrorMaterial(), position=rng.uniform(-0.5, 0.5, 3)
    )
    ball.environment = cc.Probe(parent=ball, size=16)
    return scene


def pictures(renderer, scene):
    camera = cc.PerspectiveCamera(fov=60, position=(1, 0.8, 1.2), target=(0, 0, 0))
    return renderer.render(scene, camera, (24, 24)).color, renderer.capture(scene, size=16).faces


def test_four_renderers_in_four_threads():
    scenes = [mirror_scene(seed) for seed in range(4)]
    with cc.Renderer(device=DEVICE) as renderer:
        want = [pictures(renderer, scene) for scene in scenes]

    def work(scene):
        got = []
        with cc.Renderer(device=DEVICE) as renderer:
            for step in range(6):
                scene.nodes[-1].visible = step % 2 == 1
                got.append(pictures(renderer, scene))
        return got[1::2]

    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(work, scenes))
    for scene_want, rounds in zip(want, results, strict=True):
        for got in rounds:
            for a, b in zip(got, scene_want, strict=True):
                assert_identical(a, b)


def test_one_renderer_shared_by_threads_is_serialised(new_renderer):
    renderer = new_renderer()
    scenes = [mirror_scene(seed) for seed in range(4)]
    want = [pictures(renderer, scene) for scene in scenes]
    with ThreadPoolExecutor(4) as pool:
        for _ in range(3):
            for got, scene_want in zip(
                pool.map(lambda s: pictures(renderer, s), scenes), want, strict=True
            ):
                for a, b in zip(got, scene_want, strict=True):
                    assert_identical(a, b)


def test_a_renderer_moves_between_threads(new_renderer):
    renderer = new_renderer()
    scene = mirror_scene(0)
    want = pictures(renderer, scene)
    for _ in range(3):
        with ThreadPoolExecutor(1) as pool:
            for a, b in zip(pool.submit(pictures, renderer, scene).result(), want, strict=True):
                assert_identical(a, b)


def test_an_edited_scene_is_drawn_as_it_was_at_one_moment(new_renderer):
    """A node's matrix is set as a whole: each capture shows one of the two places, never a mixture or nothing."""
    renderer = new_renderer()
    scene = cc.Scene()
    node = scene.add(cc.Mesh.box(1), cc.BasicMaterial(), position=(0, 0, -3))
    places = [np.eye(4), np.eye(4)]
    places[0][:3, 3], places[1][:3, 3] = (0, 0, -3), (3, 0, 0)
    want = []
    for place in places:
        node.matrix = place
        want.append(renderer.capture(scene, size=8).faces.tobytes())
    stop = threading.Event()

    def edit():
        step = 0
        while not stop.is_set():
            node.matrix = places[step % 2]
            step += 1

    thread = threading.Thread(target=edit)
    thread.start()
    try:
        seen = {renderer.capture(scene, size=8).faces.tobytes() for _ in range(60)}
    finally:
        stop.set()
        thread.join()
    assert seen <= set(want)


def test_set_face_while_drawing_gives_old_or_new_faces(new_renderer):
    renderer = new_renderer()
    cube = cc.CubeMap(np.zeros((6, 32, 32, 3), np.float32))
    scene = cc.Scene(background=cube)
    stop = threading.Event()

    def edit():
        step = 0
        while not stop.is_set():
            cube.set_face(step % 6, np.full((32, 32, 3), step // 6 % 2, np.float32))
            step += 1

    thread = threading.Thread(target=edit)
    thread.start()
    try:
        for _ in range(40):
            faces = renderer.capture(scene, size=16).faces[..., :3]
            assert set(np.unique(faces[:, 4:-4, 4:-4])) <= {0, 1}
            assert all(len(np.unique(face[4:-4, 4:-4])) == 1 for face in faces)
    finally:
        stop.set()
        thread.join()


@pytest.mark.slow
def test_the_gil_is_released_while_drawing(new_renderer):
    """A thread that only counts goes on counting during one long draw."""
    renderer = new_renderer()
    scene = cc.Scene(environment=cc.CubeMap(smooth_environment(16)))
    scene.add(cc.Mesh.sphere(4, segments=256, rings=128), cc.GlassMaterial(double_sided=True))
    renderer.capture(scene, size=16)
    ticks, stop = [], threading.Event()

    def count():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.002)

    thread = threading.Thread(target=count)
    thread.start()
    try:
        begin = time.perf_counter()
        renderer.capture(scene, size=512, samples=4)
        end = time.perf_counter()
    finally:
        stop.set()
        thread.join()
    during = sum(begin < tick < end for tick in ticks)
    assert end - begin > 0.05, "too short a draw to tell"
    assert during > (end - begin) / 0.002 / 20


def test_cpu_work_runs_in_threads_too():
    """Four threads call methods of one CubeMap."""
    cube = cc.CubeMap(smooth_environment(32))
    want = cube.to_equirect(width=128)
    with ThreadPoolExecutor(4) as pool:
        for got in pool.map(lambda _: cube.to_equirect(width=128), range(8)):
            assert_identical(got, want)
