"""P12, P13 and P14 of the source documents against ray casting, over some frames."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.compare import assert_close
from tests.gl.world import (
    World,
    capture_hits,
    inner,
    inner_smooth,
    perspective,
    smooth_environment,
)
from tests.reference import transforms as ref
from tests.reference.cube_faces import texel_directions
from tests.reference.raycast import interior
from tests.reference.sampling import sample_faces

LIGHT = shading.Point((5, 5, 5))
GREY = (0.4, 0.4, 0.4, 1)
NEAR, FAR, SIZE = 1, 100, 40


@pytest.fixture(scope="module")
def meshes():
    return [cc.load_mesh(cc.sample_data(f"{name}.obj"), size=1.2) for name in ("bunny", "teapot")]


def phong(color):
    return cc.PhongMaterial(color=color)


def hall(ceiling):
    world = World(cc.Scene(background=GREY))
    world.scene.add(cc.PointLight(position=LIGHT.position))
    world.plane(10, 10, (0.4, 0.4, 1), material=phong((0.4, 0.4, 1)), position=(0, -2, 0))
    if ceiling:
        world.plane(
            10,
            10,
            (0.4, 1, 1),
            material=phong((0.4, 1, 1)),
            position=(0, 3, 0),
            axis=(1, 0, 0),
            degrees=180,
        )
    return world


def lit(world, hits, eye):
    """The Phong model of document 000 for every pixel, over the grey background."""
    color = world.paint(hits, GREY)
    hit = hits.hit
    shaded = shading.phong(hits.position[hit], hits.normal[hit], eye, color[hit][:, :3], [LIGHT])
    color[hit, :3] = shaded
    return color


@pytest.fixture(scope="module")
def world(meshes):
    """The scene of P13 without the cube that shows it."""
    made = hall(ceiling=True)
    places = [(-2, -0.5, 2), (2.5, -0.5, 1.5)]
    for mesh, color, place in zip(meshes, [(0.4, 1, 0.4), (1, 0.4, 0.4)], places, strict=True):
        made.mesh(mesh, color, material=phong(color), position=place)
    return made


@pytest.fixture(scope="module")
def cube(world, shared_renderers):
    return shared_renderers(None).capture(world.scene, size=SIZE, near=NEAR, far=FAR)


class TestP13:
    """The captured cubemap shown on a rotating cube."""

    def test_faces(self, world, cube):
        hits = capture_hits(world, size=SIZE, near=NEAR, far=FAR)
        assert set(np.unique(hits.id)) == {0, 1, 2, 3, 4}
        assert_close(cube.faces, lit(world, hits, (0, 0, 0)), "phong", mask=inner_smooth(hits))

    @pytest.mark.parametrize("step", [0, 1, 40, 333])
    def test_cube_in_the_main_view(self, world, cube, renderer, step):
        show = World(cc.Scene(background=GREY))
        show.box(
            1,
            material=cc.BasicMaterial(cubemap=cube),
            position=(0, 0.8, 0),
            axis=(1, 1, 1),
            degrees=0.45 * step,
            scale=0.8,
        )
        view = perspective((0, 1, 5), (0, 0, 0), fov=70, size=(64, 64), near=1, far=100)
        frame = renderer.render(show.scene, view.camera, view.size, format="rgba32f")
        hits = view.hits(show.shapes)
        mask = inner(hits)
        want = np.where(
            hits.hit[..., None], sample_faces(cube.faces, np.nan_to_num(hits.local, nan=1.0)), GREY
        )
        want[..., 3] = 1
        assert hits.hit.sum() > 50
        # A texel of the cube is about a pixel wide, so a shift by a tenth of a texel is visible.
        difference = np.abs(frame.color - want)[mask]
        assert difference.mean() < 2e-3
        assert np.quantile(difference, 0.98) < 0.02


class TestP14:
    """The dynamic reflection: actors circle a mirror ball."""

    RADIUS, TURN = 2.5, 0.1

    def stage(self, meshes, step):
        world = hall(ceiling=False)
        for index, (mesh, color) in enumerate(
            zip(meshes, [(0.4, 1, 0.4), (1, 0.4, 0.4)], strict=True)
        ):
            angle = step * self.TURN + index * np.pi
            place = (self.RADIUS * np.cos(angle), -0.5, self.RADIUS * np.sin(angle))
            world.mesh(mesh, color, material=phong(color), position=place)
        ball = world.sphere(
            1,
            (0.95, 0.85, 0.4),
            subdivisions=3,
            material=cc.MirrorMaterial(color=(0.95, 0.85, 0.4), env_weight=0.78, color_weight=0.3),
            scale=0.5,
        )
        ball.environment = cc.Probe(
            position=(0, 0, 0), size=SIZE, near=NEAR, far=FAR, format="rgba32f"
        )
        return world, ball

    @pytest.mark.parametrize("step", [0, 17])
    def test_frame(self, meshes, shared_renderers, step):
        """Both paths draw the frame; the rays, which take the time, are cast only once."""
        world, ball = self.stage(meshes, step)
        view = perspective((0, 1, 5), (0, 0, 0), fov=70, size=(80, 80), near=1, far=100)
        seen = capture_hits(world, size=SIZE, near=NEAR, far=FAR, shapes=world.without(ball))
        hits = view.hits(world.shapes)
        for layered in (None, False):
            renderer = shared_renderers(layered)
            frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
            held = renderer.read_probe(ball.environment)
            assert_close(held.faces, lit(world, seen, (0, 0, 0)), "phong", mask=inner_smooth(seen))
            self.check(frame.color, held, hits, world, view, ball)

    def check(self, color, held, hits, world, view, ball):
        """Compare the ball with a lookup in the contents of its probe, and the rest with Phong."""
        want = lit(world, hits, view.eye)
        on_ball = hits.id == ball.id
        reflected = shading.reflect(view.directions()[on_ball], hits.normal[on_ball])
        own = 0.3 * np.array([0.95, 0.85, 0.4])
        want[on_ball, :3] = 0.78 * sample_faces(held.faces, reflected)[:, :3] + own
        mask = inner_smooth(hits)
        assert (mask & on_ball).sum() > 40
        assert_close(color, want, "phong", mask=mask & ~on_ball)
        # The ball magnifies an error of N, and the faces have edges: most pixels are close, and the
        # mean difference is small.
        difference = np.abs(color - want)[mask & on_ball]
        assert difference.mean() < 4e-3
        assert np.quantile(difference, 0.9) < 0.02

    def test_it_follows(self, meshes, renderer):
        """One scene whose actors move gives the same pictures as a new scene for each frame."""
        world, _ = self.stage(meshes, 0)
        camera = cc.PerspectiveCamera(fov=70, position=(0, 1, 5), target=(0, 0, 0), near=1, far=100)
        for step in (0, 1, 2):
            for index, node in enumerate(world.scene.nodes[1:3]):
                angle = step * self.TURN + index * np.pi
                node.position = (self.RADIUS * np.cos(angle), -0.5, self.RADIUS * np.sin(angle))
            got = renderer.render(world.scene, camera, (32, 32), format="rgba32f").color
            new, _ = self.stage(meshes, step)
            want = renderer.render(new.scene, camera, (32, 32), format="rgba32f").color
            np.testing.assert_array_equal(got, want)

    def test_refraction(self, meshes, renderer):
        """P17: a glass ball instead of the mirror ball."""
        world, ball = self.stage(meshes, 3)
        ball.material = cc.GlassMaterial(fresnel=False)
        view = perspective((0, 1, 5), (0, 0, 0), fov=30, size=(64, 64), near=1, far=100)
        frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
        held = renderer.read_probe(ball.environment)
        hits = view.hits(world.shapes)
        mask = inner_smooth(hits) & (hits.id == ball.id)
        bent = shading.refract(view.directions()[mask], hits.normal[mask], 1 / 1.52)
        difference = np.abs(frame.color[mask][:, :3] - sample_faces(held.faces, bent)[:, :3])
        assert difference.mean() < 4e-3
        assert np.quantile(difference, 0.9) < 0.02


class TestP12:
    """The cube camera: skybox, moving coloured cubes, a reflective sphere that leaves itself out."""

    @pytest.mark.parametrize("step", [0, 7])
    def test_capture(self, any_path, step):
        environment = smooth_environment(32)
        world = World(cc.Scene(environment=cc.CubeMap(environment)))
        rng = np.random.default_rng(12)
        for _ in range(8):
            place = ref.rotation(ref.axis_angle((0, 1, 0), 10 * step))[:3, :3] @ (
                normalised(rng.normal(size=3)) * 6
            )
            world.box(
                2, rng.random(3), position=place, axis=rng.normal(size=3), degrees=20 * step + 10
            )
        ball = world.sphere(1, material=cc.MirrorMaterial())
        ball.environment = cc.Probe(
            position=(0, 0, 0), size=SIZE, near=NEAR, far=FAR, format="rgba32f"
        )
        any_path.update_probes(world.scene)
        held = any_path.read_probe(ball.environment)
        hits = capture_hits(world, size=SIZE, near=NEAR, far=FAR, shapes=world.without(ball))
        want = world.paint(hits)
        want[~hits.hit, :3] = sample_faces(environment, texel_directions(SIZE))[~hits.hit]
        want[..., 3] = 1
        assert_close(held.faces, want, "shaded", mask=interior(hits.id))
