"""`max_lod_error`: which level of a mesh is drawn, how far its picture may be off, and what it does not change."""

import asyncio
import copy
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.surfaces import bumpy

SIZE = 96
HEAD: Any = ("distance", "normal", "id")


def ball(*errors):
    """An octahedron of 512 triangles with levels of 400, 300, ... that are parts of it, and these errors."""
    mesh = cc.Mesh.icosphere(1, 2)
    counts = [len(mesh.indices) - 20 * (i + 1) for i in range(len(errors))]
    mesh.levels = [(mesh.indices[:n], e) for n, e in zip(counts, errors, strict=True)]
    return mesh


def drawn_level(stats, mesh, views=1):
    """The number of the level that was drawn; 0: the mesh."""
    counts = [len(mesh.indices), *(len(indices) for indices, _ in mesh.levels)]
    assert stats.triangles % views == 0
    found = counts.index(stats.triangles // views)
    assert stats.triangles_simplified == views * (counts[0] - counts[found])
    return found


# ----------------------------------------------------------------------------------------------------
# The choice, against the formula in numpy
# ----------------------------------------------------------------------------------------------------


def box_of(mesh, matrix):
    """The corners of the box round the mesh's box, in the world."""
    low, high = mesh.bounds
    corners = np.array([(x, y, z, 1) for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    corners = corners[:, :3] * (high - low) + low
    world = corners @ matrix[:3, :3].T + matrix[:3, 3]
    low, high = world.min(0), world.max(0)
    return np.array([np.where(mask, high, low) for mask in np.ndindex(2, 2, 2)]), low, high


def largest_scale(matrix):
    product = matrix[:3, :3].T @ matrix[:3, :3]
    return np.sqrt(np.abs(product).sum(axis=0).max())


def wanted_level(mesh, matrix, view, tangents, pixels_per_unit, limit):
    """By the sentence of `Renderer.render`: `view` (4, 4) is world to camera, `tangents` that of a picture's corner."""
    corners, low, high = box_of(mesh, matrix)
    seen = corners @ view[:3, :3].T + view[:3, 3]
    depth = -seen[:, 2]
    eye = np.linalg.inv(view)[:3, 3]
    away = np.linalg.norm(np.clip(eye, low, high) - eye)
    chosen = 0
    for number, (_, error) in enumerate(mesh.levels, 1):
        error = error * largest_scale(matrix)
        widest = tangents
        if depth.min() > 0:
            widest = min(widest, np.hypot(seen[:, 0] / depth, seen[:, 1] / depth).max())
        nearest = max(depth.min(), away / np.hypot(1, tangents) - error)
        if nearest > 0 and pixels_per_unit * error * np.hypot(1, widest) / nearest <= limit:
            chosen = number
    return chosen


def random_place(rng, reach):
    matrix = np.eye(4)
    matrix[:3, :3] = cc.axis_angle_matrix(rng) if hasattr(cc, "axis_angle_matrix") else _turn(rng)
    matrix[:3, :3] = matrix[:3, :3] @ np.diag(rng.uniform(0.3, 1.5, 3))
    matrix[:3, 3] = reach
    return matrix


def _turn(rng):
    q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return q * np.sign(np.linalg.det(q))


def test_the_choice_of_a_perspective(renderer, rng):
    mesh = ball(0.02, 0.05, 0.2, 0.5)
    width, height, fov = 80, 60, 50.0
    found = []
    for _ in range(60):
        scene = cc.Scene()
        z = -np.exp(rng.uniform(np.log(2.5), np.log(200)))
        matrix = random_place(
            rng, (rng.uniform(-0.3, 0.3) * -z * 0.5, rng.uniform(-0.2, 0.2) * -z * 0.5, z)
        )
        scene.add(mesh, cc.BasicMaterial(), matrix=matrix)
        limit = float(rng.choice([0.3, 1, 3]))
        camera = cc.PerspectiveCamera(fov=fov, near=0.01, far=1000)
        renderer.render(scene, camera, (width, height), max_lod_error=limit)
        half = np.tan(np.radians(fov) / 2)
        tangents = np.hypot(half, half * width / height)
        want = wanted_level(mesh, matrix, np.eye(4), tangents, height / 2 / half, limit)
        assert drawn_level(renderer.stats, mesh) == want
        found.append(want)
    assert set(found) == {0, 1, 2, 3, 4}


def test_the_choice_of_a_parallel_view(renderer):
    mesh = ball(0.001, 0.01, 0.1)
    for scale, limit in ((1, 0.5), (1, 0.1), (1, 1.1), (0.1, 0.5), (3, 0.05), (2, 0.02)):
        scene = cc.Scene()
        scene.add(mesh, cc.BasicMaterial(), position=(0, 0, -5), scale=scale)
        camera = cc.OrthographicCamera(height=8, near=0.01, far=20)
        renderer.render(scene, camera, (40, 80), max_lod_error=limit)
        want = sum(error * scale * 10 <= limit for _, error in mesh.levels)
        assert drawn_level(renderer.stats, mesh) == want


@pytest.mark.parametrize("layered", [True, False])
def test_all_faces_of_a_cube_show_the_same_level(new_renderer, rng, layered):
    """The face that asks for the finest level decides; the node may reach into three faces."""
    renderer = new_renderer(layered=layered)
    mesh = ball(0.02, 0.05, 0.2, 0.5)
    axes = {"+x": (0, 1), "-x": (0, -1), "+y": (1, 1), "-y": (1, -1), "+z": (2, 1), "-z": (2, -1)}
    found = []
    for _ in range(40):
        direction = rng.normal(size=3)
        matrix = random_place(
            rng, direction / np.linalg.norm(direction) * np.exp(rng.uniform(0.8, 3.2))
        )
        scene = cc.Scene()
        scene.add(mesh, cc.BasicMaterial(), matrix=matrix)
        cube = renderer.capture(scene, (0, 0, 0), 64, max_lod_error=0.7, outputs=("id",))
        views = renderer.stats.triangles
        wants = []
        for number, (axis, sign) in enumerate(axes.values()):
            back = np.zeros(3)
            back[axis] = -sign
            view = np.eye(4)
            side = np.eye(3)[(axis + 1) % 3]
            view[:3, :3] = np.stack([side, np.cross(back, side), back])
            want = wanted_level(mesh, matrix, view, np.sqrt(2), 32, 0.7)
            if (cube.id[number] != 0).any():
                wants.append(want)
        counts = [len(mesh.indices), *(len(indices) for indices, _ in mesh.levels)]
        exact = renderer.stats.triangles_simplified + renderer.stats.triangles
        assert exact % counts[0] == 0  # one count for all views, of one level
        level = counts.index(views * counts[0] // exact)
        assert level <= min(wants)
        if len(wants) == exact // counts[0]:
            assert level == min(wants)
        found.append(level)
    assert len(set(found)) >= 4


def test_inside_the_bounds_the_mesh_is_exact(renderer):
    mesh = ball(1e-9)
    scene = cc.Scene()
    scene.add(mesh, cc.BasicMaterial(double_sided=True))
    renderer.capture(scene, (0.3, 0, 0.2), 16, max_lod_error=1e9)
    assert renderer.stats.triangles_simplified == 0
    assert renderer.stats.triangles + renderer.stats.triangles_skipped > 0


# ----------------------------------------------------------------------------------------------------
# The pictures
# ----------------------------------------------------------------------------------------------------


def grown(mask, radius):
    """Whether any pixel of a mask lies within a radius."""
    found = np.zeros_like(mask)
    reach = int(np.floor(radius))
    padded = np.pad(mask, reach)
    for y in range(-reach, reach + 1):
        for x in range(-reach, reach + 1):
            if x * x + y * y <= radius * radius:
                found |= padded[
                    reach + y : reach + y + mask.shape[0], reach + x : reach + x + mask.shape[1]
                ]
    return found


SHAPES = {
    "sphere": (lambda: cc.Mesh.sphere(1, 32, 16), 4),
    "teapot": (lambda: cc.load_mesh(cc.sample_data("teapot.obj"), size=2), 4),
    "hills": (lambda: bumpy(24), 2),
}


@pytest.mark.parametrize("name", SHAPES)
def test_silhouettes_are_off_by_no_more_than_the_error(renderer, name):
    """A pixel's center is covered or not, so a silhouette may be off by one pixel more."""
    make, near = SHAPES[name]
    mesh = make().with_levels()
    saved = []
    for limit in (0.5, 2.0, 6.0):
        for factor in (1, 3):
            scene = cc.Scene()
            turn = cc.axis_angle((1, 2, 0), 40)
            scene.add(mesh, cc.BasicMaterial(double_sided=True), rotation=turn)
            camera = cc.PerspectiveCamera(position=(0, 0, near * factor), target=(0, 0, 0), fov=40)
            exact = renderer.render(scene, camera, (SIZE, SIZE), outputs=("id",)).id != 0
            level = renderer.render(
                scene, camera, (SIZE, SIZE), outputs=("id",), max_lod_error=limit
            )
            saved.append(renderer.stats.triangles_simplified / len(mesh.indices))
            level = level.id != 0
            assert exact.any()
            assert not exact.all()
            assert not (level & ~grown(exact, limit + 1)).any()
            assert not (exact & ~grown(level, limit + 1)).any()
    assert max(saved) > 0.7  # else nothing was tried
    assert np.mean(saved) > 0.3


def world(rng, count=6):
    scene = cc.Scene(background=(0.2, 0.3, 0.4))
    scene.add(cc.DirectionalLight((-0.3, -1, -0.2)))
    meshes = [cc.Mesh.sphere(0.5).with_levels(), cc.Mesh.torus(0.5, 0.2).with_levels()]
    for number in range(count):
        material = cc.PhongMaterial(color=tuple(rng.random(3)), opacity=0.5 if number == 1 else 1)
        scene.add(
            meshes[number % 2],
            material,
            position=rng.uniform(-4, 4, 3),
            rotation=rng.normal(size=4),
            scale=rng.uniform(0.4, 1.2, 3),
        )
    scene.add(cc.Mesh.plane(9, 9), cc.PhongMaterial(), position=(0, -3, 0))
    return scene


def test_without_the_option_nothing_changes(any_path, rng):
    plain, leveled = cc.Scene(), cc.Scene()
    for scene, mesh in ((plain, cc.Mesh.sphere(1)), (leveled, cc.Mesh.sphere(1).with_levels())):
        for x in (-3, 0, 4):
            scene.add(mesh, cc.BasicMaterial(color=(0.5, 0.2, 0.9)), position=(x, 0.5, -9))
    camera = cc.PerspectiveCamera()
    for limit in (0, 0.0):
        a = any_path.capture(plain, size=24, outputs=HEAD)
        b = any_path.capture(leveled, size=24, outputs=HEAD, max_lod_error=limit)
        assert any_path.stats.triangles_simplified == 0
        assert_identical(a.faces, b.faces)
        for name in HEAD:
            assert_identical(getattr(a, name), getattr(b, name))
        a = any_path.render(plain, camera, (40, 30))
        assert_identical(
            a.color, any_path.render(leveled, camera, (40, 30), max_lod_error=limit).color
        )


def test_a_level_is_drawn_as_if_it_were_the_mesh(any_path):
    """Colours, uvs and normals are those of its vertices: the bytes of a mesh of the same triangles."""
    rng = np.random.default_rng(3)
    full = cc.Mesh.sphere(1)
    mesh = cc.Mesh(
        full.positions,
        full.indices,
        normals=full.normals,
        uvs=full.uvs,
        colors=rng.random((len(full.positions), 3)),
    )
    mesh.levels = mesh.with_levels().levels[:2]
    alone = cc.Mesh(
        mesh.positions, mesh.levels[1][0], normals=mesh.normals, uvs=mesh.uvs, colors=mesh.colors
    )
    pictures = []
    for shown, limit in ((mesh, 50), (alone, 0)):
        scene = cc.Scene()
        scene.add(cc.PointLight((0, 3, 0)))
        look = cc.PhongMaterial(map=rng.random((4, 4, 3)) * 0 + 0.5, vertex_colors=True)
        scene.add(shown, look, position=(0.3, 0.2, -4))
        pictures.append(any_path.capture(scene, size=32, outputs=HEAD, max_lod_error=limit))
    assert_identical(pictures[0].faces, pictures[1].faces)
    for name in HEAD:
        assert_identical(getattr(pictures[0], name), getattr(pictures[1], name))


@pytest.mark.parametrize("limit", [0.5, 4.0])
def test_batches_and_later_calls_have_the_bytes_of_single_calls(new_renderer, rng, limit):
    for layered in (None, True):
        renderer = new_renderer(layered=layered)
        scene = world(rng, 24)
        places = rng.uniform(-6, 6, (5, 3))
        options: Any = {"outputs": HEAD, "max_lod_error": limit}
        singles = [renderer.capture(scene, place, 24, **options) for place in places]
        assert renderer.stats.triangles_simplified > 0
        for cubes in (
            renderer.capture_many(scene, places, 24, **options),
            renderer.iter_captures(scene, places, 24, **options),
            [renderer.capture_async(scene, place, 24, **options).result() for place in places],
        ):
            for cube, single in zip(cubes, singles, strict=True):
                assert_identical(cube.faces, single.faces)
                for name in HEAD:
                    assert_identical(cube.outputs[name], single.outputs[name])
        make = [scene].__getitem__
        made = cc.capture_scenes(make, 1, position=places[0], size=24, renderer=renderer, **options)
        assert_identical(made.faces[0], singles[0].faces)
        cameras = [cc.PerspectiveCamera(position=place, target=(0, 0, 0)) for place in places]
        frames = [renderer.render(scene, camera, (40, 30), **options) for camera in cameras]
        assert renderer.stats.triangles_simplified > 0
        many = renderer.render_many(scene, cameras, (40, 30), **options)
        later = asyncio.run(_gathered(renderer, scene, cameras, options))
        for number, frame in enumerate(frames):
            assert_identical(many.color[number], frame.color)
            assert_identical(later[number].color, frame.color)


async def _gathered(renderer, scene, cameras, options):
    return await asyncio.gather(
        *(renderer.render_async(scene, camera, (40, 30), **options) for camera in cameras)
    )


@pytest.mark.parametrize("samples", [1, 4])
def test_a_picture_after_edits_is_one_from_scratch(new_renderer, rng, samples):
    """Nodes move nearer and farther, the option changes, levels come and go; only rectangles are drawn again."""
    live, scratch = new_renderer(), new_renderer()
    scene = world(rng)
    mirror = scene.add(cc.Mesh.plane(3, 3), cc.MirrorMaterial(), position=(0, -2.5, 0))
    mirror.environment = cc.PlanarMirror()
    globe = scene.add(cc.Mesh.sphere(0.4).with_levels(), cc.MirrorMaterial(), position=(1, 0, 2))
    globe.environment = cc.Probe(parent=globe, size=8)
    pane = cc.StandardMaterial(transmission=0.9, roughness=0.3)
    scene.add(cc.Mesh.box(0.8), pane, position=(-1, 0.5, 2.5))
    camera = cc.PerspectiveCamera(position=(0, 0.5, 6), target=(0, 0, 0))
    limit, saved = 1.0, []
    movers = [node for node in scene.nodes if node.mesh is not None and node.mesh.levels]
    original = movers[0].mesh.levels
    for step in range(12):
        match step % 5:
            case 0:
                rng.choice(np.array(movers, object)).position = rng.uniform(-3, 3, 3)
            case 1:
                limit = float(rng.choice([0, 0.3, 1, 2, 5]))
            case 2:
                node = rng.choice(np.array(movers, object))
                node.scale = rng.uniform(0.3, 1.3)
            case 3:
                movers[0].mesh.levels = () if movers[0].mesh.levels else original[: 2 + step % 3]
            case 4:
                movers[2].position = (0.2, 0, 4.0 - 3 * (step % 3))
        options: Any = {"samples": samples, "max_lod_error": limit}
        again = copy.deepcopy(scene)
        got = live.render(scene, camera, (64, 48), outputs=HEAD, screen_reflections=True, **options)
        saved.append(live.stats.triangles_simplified)
        want = scratch.render(
            again, camera, (64, 48), outputs=HEAD, screen_reflections=True, **options
        )
        assert_identical(got.color, want.color, f"frame of step {step}")
        for name in HEAD:
            assert_identical(getattr(got, name), getattr(want, name), f"{name} of step {step}")
        got = live.capture(scene, (0, 0.2, 0), 24, outputs=HEAD, **options)
        want = scratch.capture(again, (0, 0.2, 0), 24, outputs=HEAD, **options)
        assert_identical(got.faces, want.faces, f"capture of step {step}")
    assert np.count_nonzero(saved) > 3


def test_only_what_changes_its_level_is_drawn_again(renderer):
    """Two balls: the farther one changes its level with the option, the nearer one does not."""
    mesh = ball(0.05)
    scene = cc.Scene()
    scene.add(mesh, cc.BasicMaterial(), position=(-2, 0, -6))
    scene.add(mesh, cc.BasicMaterial(), position=(60, 0, -120))
    camera = cc.PerspectiveCamera(fov=60)
    counts = []
    for limit in (0.01, 0.2, 0.2, 0.01):
        renderer.render(scene, camera, (64, 64), max_lod_error=limit)
        counts.append((renderer.stats.views_drawn, renderer.stats.triangles))
    exact, level = len(mesh.indices), len(mesh.levels[0][0])
    assert counts == [(1, 2 * exact), (1, level), (0, 0), (1, exact)]


def test_a_crowd_has_levels_of_its_own(renderer):
    """Nodes of one crowd at several distances; each draws what its distance allows."""
    mesh = ball(0.05, 0.3)
    scene = cc.Scene()
    places = [(x, y, -5.0 * 2.5**z) for x in (-1.2, 1.2) for y in (-1.2, 1.2) for z in range(6)]
    for place in places:
        scene.add(mesh, cc.BasicMaterial(), position=place)
    camera = cc.PerspectiveCamera(fov=60, far=2000)
    frame = renderer.render(scene, camera, (64, 64), outputs=("id",), max_lod_error=0.5)
    half = np.tan(np.radians(30))
    wanted = 0
    counts = [len(mesh.indices), *(len(indices) for indices, _ in mesh.levels)]
    used = set()
    for place in places:
        matrix = np.eye(4)
        matrix[:3, 3] = place
        level = wanted_level(mesh, matrix, np.eye(4), np.hypot(half, half), 32 / half, 0.5)
        used.add(level)
        wanted += counts[level]
    assert used == {0, 1, 2}
    assert renderer.stats.triangles == wanted
    assert renderer.stats.draw_calls < len(places)
    assert frame.id.max() > 0


# ----------------------------------------------------------------------------------------------------
# What stays exact
# ----------------------------------------------------------------------------------------------------


def far_scene(material, **options):
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(1).with_levels(), material, position=(0, 0, -30), **options)
    return scene


def saved(renderer, scene, **options):
    renderer.capture(scene, size=32, max_lod_error=2, **options)
    return renderer.stats.triangles_simplified


MOVES = "vec3 displace(Vertex v) { return v.position; }"


def test_the_exceptions(renderer):
    assert saved(renderer, far_scene(cc.BasicMaterial())) > 0
    assert saved(renderer, far_scene(cc.BasicMaterial(opacity=0.5))) > 0
    assert saved(renderer, far_scene(cc.GlassMaterial())) > 0
    assert saved(renderer, far_scene(cc.GlassMaterial(surfaces=2))) == 0
    assert saved(renderer, far_scene(cc.PhongMaterial(flat_shading=True))) == 0
    shade = "vec3 shade(Surface s) { return vec3(1.0); }"
    assert saved(renderer, far_scene(cc.ShaderMaterial(fragment=shade))) > 0
    counting = "vec3 shade(Surface s) { return vec3(float(gl_PrimitiveID)); }"
    assert saved(renderer, far_scene(cc.ShaderMaterial(fragment=counting))) == 0


def test_what_shadows_fall_on_and_come_from_is_exact(renderer):
    scene = far_scene(cc.PhongMaterial())
    scene.add(cc.PointLight((5, 5, -25), shadow=cc.Shadow(size=16)))
    ball = scene.nodes[0]
    renderer.capture(scene, size=32, max_lod_error=2)
    assert renderer.stats.triangles_simplified == 0
    assert renderer.stats.shadow_views_drawn == 6
    ball.cast_shadow = False
    assert saved(renderer, scene) > 0
    ball.cast_shadow, ball.receive_shadow = True, False
    assert saved(renderer, scene) > 0


def test_deformed_meshes_are_exact(renderer):
    scene = far_scene(cc.BasicMaterial())
    mesh = scene.nodes[0].mesh
    mesh.morph_targets = [cc.MorphTarget(positions=np.ones((len(mesh.positions), 3)))]
    assert len(mesh.levels) > 2
    assert saved(renderer, scene) == 0


def test_probes_are_exact(renderer):
    scene = far_scene(cc.BasicMaterial())
    globe = scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(0, 0, 30))
    globe.environment = cc.Probe(parent=globe, size=16)
    camera = cc.PerspectiveCamera(position=(0, 0, 25), target=(0, 0, 30))
    renderer.render(scene, camera, (32, 32), max_lod_error=1e6)
    assert renderer.stats.probes_updated == 1
    assert renderer.stats.triangles_simplified == 0


def test_planar_mirrors_show_levels(renderer):
    scene = far_scene(cc.BasicMaterial())
    scene.nodes[0].position = (0, 3, -30)
    sheet = scene.add(cc.Mesh.plane(60, 60), cc.MirrorMaterial(), position=(0, -1, -20))
    sheet.environment = cc.PlanarMirror()
    camera = cc.PerspectiveCamera(fov=50)
    renderer.render(scene, camera, (48, 48), max_lod_error=2)
    twice = renderer.stats.triangles_simplified
    sheet.visible = False
    renderer.render(scene, camera, (48, 48), max_lod_error=2)
    assert twice > renderer.stats.triangles_simplified > 0


@pytest.mark.parametrize("limit", [-1, -1e-9, np.nan, np.inf, -np.inf])
def test_a_bad_limit_is_refused(renderer, limit):
    scene, camera = cc.Scene(), cc.PerspectiveCamera()
    text = "max_lod_error: expected pixels, finite and not negative, got"
    for call in (
        lambda: renderer.capture(scene, size=4, max_lod_error=limit),
        lambda: renderer.render(scene, camera, (4, 4), max_lod_error=limit),
        lambda: renderer.capture_many(scene, np.zeros((1, 3)), 4, max_lod_error=limit),
        lambda: renderer.render_many(scene, [camera], (4, 4), max_lod_error=limit),
        lambda: renderer.capture_async(scene, size=4, max_lod_error=limit).result(),
    ):
        with pytest.raises(ValueError, match=text):
            call()
