"""Shadows against ray casting: in frames, captures, probes and mirrors; filter, bias, what casts and what receives."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.compare import assert_close
from tests.gl.shadows import Lamp, around, lamps, lit, stage, with_shapes
from tests.gl.world import World, capture_hits, inner, orthographic, perspective
from tests.reference import transforms as ref

kinds = pytest.mark.parametrize("kind", ["directional", "spot", "point"])
VIEWS = {"above": ((0.4, 5, 1.5), (0.1, 0, 0)), "left": ((-3, 1.6, 2), (0, 0.4, 0))}


def picture(renderer, scene, view, **options):
    return renderer.render(scene, view.camera, view.size, format="rgba32f", **options).color[
        ..., :3
    ]


@kinds
@pytest.mark.parametrize("radius", [0, 1, 2.5])
@pytest.mark.parametrize("place", VIEWS.values(), ids=VIEWS)
def test_a_frame(renderer, kind, radius, place):
    world, lamp = stage(), lamps(512, radius)[kind]
    world.scene.add(lamp.ours)
    view = perspective(place[0], place[1], size=(48, 36))
    hits = with_shapes(view.hits(world.shapes), world.shapes)
    want, good, shares = lit(hits, view.eye, [lamp], radius)
    assert (shares[0][good & hits.hit] == 0).mean() > 0.01
    assert_close(picture(renderer, world.scene, view), want, "phong", mask=good, least=0.6)


@kinds
def test_an_orthographic_frame_and_multisampling(renderer, kind):
    world, lamp = stage(), lamps(512)[kind]
    world.scene.add(lamp.ours)
    view = orthographic((-3, 1.6, 2), (0, 0.4, 0), size=(48, 36))
    hits = with_shapes(view.hits(world.shapes), world.shapes)
    far_eye = view.eye - view.directions()[0, 0] * 1e7
    want, good, _ = lit(hits, far_eye, [lamp])
    assert_close(picture(renderer, world.scene, view), want, "phong", mask=good, least=0.6)
    # Where two facets share a pixel, both are shaded at the pixel's centre, which lies outside one
    # of them.
    got = picture(renderer, world.scene, view, samples=4)
    assert_close(got, want, "phong", mask=good & (hits.id != 5), least=0.5)


@pytest.mark.slow
def test_all_six_faces_of_a_capture(any_path):
    """The capture has all kinds of light at once, and before them a light without a shadow."""
    world, position = stage(), (-0.2, 1, 1.9)
    plain = Lamp(
        cc.PointLight((3, 1, -3), intensity=0.4), shading.Point((3, 1, -3), intensity=0.4), None
    )
    every = [plain, *lamps(512).values()]
    for lamp in every:
        world.scene.add(lamp.ours)
    cube = any_path.capture(world.scene, position=position, size=32)
    hits = with_shapes(capture_hits(world, position, 32), world.shapes)
    want, good, shares = lit(hits, position, every)
    assert_close(cube.faces[..., :3], want, "phong", mask=good, least=0.5)
    for share in shares[1:]:
        assert (share[good & hits.hit] == 0).sum() > 30


def test_in_a_probe_and_in_the_mirror_that_shows_it(renderer):
    world, position = stage(), (-2.4, 0.9, 0.6)
    lamp = lamps(512)["point"]
    world.scene.add(lamp.ours)
    mirror = world.plane(
        1.5, 1.5, material=cc.MirrorMaterial(), position=position, axis=(0, 0, 1), degrees=-80
    )
    mirror.environment = probe = cc.Probe(position=position, size=48, format="rgba32f")
    view = perspective((0.2, 3, 0.2), position, size=(64, 48), fov=30)
    got = picture(renderer, world.scene, view)
    cube = renderer.read_probe(probe)
    seen = with_shapes(
        capture_hits(world, position, 48, shapes=world.without(mirror)), world.shapes
    )
    want, good, shares = lit(seen, position, [lamp])
    assert (shares[0][good & seen.hit] == 0).sum() > 100
    assert_close(cube.faces[..., :3], want, "phong", mask=good, least=0.5)

    hits = view.hits(world.shapes)
    mask = inner(hits) & (hits.id == mirror.id)
    shown = cube.sample(shading.reflect(view.directions(), hits.normal))[..., :3]
    assert_close(got, shown, "mirror", mask=mask, least=0.05)
    lamp.ours.shadow = None
    assert (np.abs(picture(renderer, world.scene, view) - got)[mask].max(-1) > 0.1).mean() > 0.05


@pytest.mark.parametrize("dense", [False, True])
def test_more_lights_than_the_vertex_stage_carries(renderer, dense):
    """With more than four lights the shader loops; a dense mesh reads its lights from their block."""
    world, view = stage(), perspective(*VIEWS["left"], size=(48, 36))
    every = list(lamps(512).values())
    for index in range(3):
        place = (2 - 2 * index, 3, -1 + index)
        every.append(
            Lamp(
                cc.PointLight(place, intensity=0.3, shadow=cc.Shadow(size=512)),
                shading.Point(place, intensity=0.3),
                2 / 506,
            )
        )
    for lamp in every[:3] if dense else every:
        world.scene.add(lamp.ours)
    if dense:
        world.scene.nodes[0].mesh = many(cc.Mesh.plane(7, 6), 5)
    hits = with_shapes(view.hits(world.shapes), world.shapes)
    want, good, _ = lit(hits, view.eye, every[:3] if dense else every)
    assert_close(picture(renderer, world.scene, view), want, "phong", mask=good, least=0.4)


def many(mesh, times):
    """Split each triangle into four, `times` times."""
    positions, triangles = np.asarray(mesh.positions, float), np.asarray(mesh.indices)
    for _ in range(times):
        a, b, c = (positions[triangles[:, i]] for i in range(3))
        corners = np.stack([a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2], axis=1)
        base = 6 * np.arange(len(a))[:, None]
        parts = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))
        triangles = np.concatenate([base + np.array(part) for part in parts])
        positions = corners.reshape(-1, 3)
    return cc.Mesh(positions, triangles, normals=np.broadcast_to([0, 1.0, 0], positions.shape))


# A surface that nothing shadows looks as if there were no shadows.

HEIGHTS = (90, 60, 30, 10, 3)


def sun_at(height, kind, shadow):
    """A light that shines on the floor's middle from `height` degrees above the horizon."""
    angle = np.radians(height)
    way = np.array([np.cos(angle) * 0.8, np.sin(angle), np.cos(angle) * 0.6])
    if kind == "directional":
        return cc.DirectionalLight(-way, shadow=shadow)
    if kind == "point":
        return cc.PointLight(6 * way, shadow=shadow)
    return cc.SpotLight(6 * way, -way, angle=40, shadow=shadow)


@pytest.mark.slow
@kinds
@pytest.mark.parametrize("size", [32, 256, 2048])
@pytest.mark.parametrize("radius", [0, 1, 3])
def test_a_plane_does_not_shadow_itself(renderer, kind, size, radius):
    """At any angle of the light a plane gets exactly the light that it gets without shadows."""
    scene = cc.Scene()
    floor = scene.add(
        cc.Mesh.plane(9, 7), cc.PhongMaterial(), rotation=cc.axis_angle((1, 2, 3), 25)
    )
    tilt = np.asarray(floor.world_matrix)[:3, :3]
    view = perspective((2, 4, 6), (0, 0, 0), size=(48, 36))
    for height in HEIGHTS:
        light = scene.add(sun_at(height, kind, cc.Shadow(size=size, radius=radius)))
        name = "direction" if kind == "directional" else "position"
        setattr(light, name, tilt @ getattr(light, name))
        if kind == "spot":
            light.direction = tilt @ light.direction
        got = picture(renderer, scene, view)
        light.shadow = None
        np.testing.assert_allclose(got, picture(renderer, scene, view), atol=3e-6)
        scene.remove(light)


SMOOTH = {
    "sphere": lambda: cc.Mesh.sphere(1),
    "coarse sphere": lambda: cc.Mesh.sphere(1, segments=14, rings=7),
    "icosphere": lambda: cc.Mesh.icosphere(1, subdivisions=2),
    "coarse icosphere": lambda: cc.Mesh.icosphere(1, subdivisions=1),
}


@kinds
@pytest.mark.parametrize("mesh", SMOOTH.values(), ids=SMOOTH)
@pytest.mark.parametrize("size", [256, 2048])
def test_a_ball_has_no_stripes(renderer, kind, mesh, size):
    """There are none even where the facets face away from a light that their normals still face."""
    scene = cc.Scene()
    scene.add(
        mesh(), cc.PhongMaterial(), scale=(1, 1.3, 0.8), rotation=cc.axis_angle((1, 2, 3), 40)
    )
    light = scene.add(sun_at(20, kind, cc.Shadow(size=size)))
    view = perspective((-3, 1, 1), (0, 0, 0), size=(96, 72), fov=45)
    got = picture(renderer, scene, view)
    light.shadow = None
    np.testing.assert_allclose(got, picture(renderer, scene, view), atol=4e-3)


@kinds
def test_a_card_with_normals_that_are_not_its_own(renderer, kind):
    """Leaves and grass have such normals: light from behind lights them as their normals say."""
    corners = np.array([(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)], float)
    card = cc.Mesh(corners, [(0, 1, 2), (0, 2, 3)], normals=np.tile([0, 1.0, 0.2], (4, 1)))
    scene = cc.Scene()
    scene.add(card, cc.PhongMaterial())
    way = np.array([0.3, 2, -0.6])
    shadow = cc.Shadow(size=256)
    every: dict[str, Any] = {
        "directional": cc.DirectionalLight(-way, shadow=shadow),
        "spot": cc.SpotLight(way + np.array([0, 1, 0]), -way, angle=40, shadow=shadow),
        "point": cc.PointLight(way + np.array([0, 1, 0]), shadow=shadow),
    }
    light = scene.add(every[kind])
    view = perspective((0.5, 1.5, 4), (0, 1, 0), size=(48, 36))
    got = picture(renderer, scene, view)
    light.shadow = None
    plain = picture(renderer, scene, view)
    assert (plain[..., 0] > 0.3).any()
    np.testing.assert_allclose(got, plain, atol=1e-5)


# A shadow begins at the foot of its caster.


@kinds
@pytest.mark.parametrize("size", [256, 1024])
@pytest.mark.parametrize("thing", ["box", "thin box", "plane"])
def test_contact(renderer, kind, size, thing):
    """Seen from above, the shadow behind a thing on the floor begins within one texel."""
    scene = cc.Scene()
    matte: dict[str, Any] = {"color": (1, 1, 1), "ka": 0, "ks": 0, "kd": 1}
    scene.add(cc.Mesh.plane(6, 6), cc.PhongMaterial(**matte))
    if thing == "plane":
        scene.add(
            cc.Mesh.plane(1, 2),
            cc.PhongMaterial(**matte, double_sided=True),
            position=(0, 0.5, 0),
            rotation=cc.axis_angle((0, 0, 1), 90),
        )
    else:
        width = 0.6 if thing == "box" else 0.02
        scene.add(
            cc.Mesh.box((width, 1, 2)), cc.PhongMaterial(**matte), position=(-width / 2, 0.5, 0)
        )
    way = np.array([-3, 3, 0.4])
    shadow = cc.Shadow(size=size)
    every: dict[str, tuple[Any, float]] = {
        "directional": (cc.DirectionalLight(-way, shadow=shadow), 7 / size),
        "spot": (cc.SpotLight(way, -way, angle=40, shadow=shadow), 2 * 0.84 * 4.3 / (size - 6)),
        "point": (cc.PointLight(way, shadow=shadow), 2 * 4.3 / (size - 6)),
    }
    light, texel = every[kind]
    scene.add(light)
    camera = cc.OrthographicCamera(
        height=0.8, position=(0.4, 5, 0), target=(0.4, 0, 0), up=(0, 0, -1)
    )
    dark = renderer.render(scene, camera, (400, 400), format="rgba32f").color[:, :, 0]
    light.shadow = None
    share = (dark / renderer.render(scene, camera, (400, 400), format="rgba32f").color[:, :, 0])[
        100:300, 2:
    ]
    first = (share > 0.5).sum(axis=1) * 0.8 / 400  # x grows to the right, from the foot
    # Light meets the floor at 45 degrees, so a texel on the floor is as long as its diagonal.
    assert first.max() < np.sqrt(2) * texel
    assert (share[:, -50:] == 0).all()


# No seams are visible between a point light's six views.

EDGES = [(x, y, 0) for x in (1, -1) for y in (1, -1)]
EDGES += [(x, 0, y) for x, y, _ in EDGES] + [(0, x, y) for x, y, _ in EDGES]
PLACE = (0.1, 0.2, -0.1)


@pytest.fixture(scope="module")
def cage(shared_renderers):
    """A room with a lamp, a box in front of each edge of the lamp's cube, and two more on corners."""
    world = World()
    white = cc.PhongMaterial(color=(1, 1, 1), ka=0, ks=0, kd=1, double_sided=True)
    world.box((7, 6, 8), material=white)
    for index, way in enumerate([*EDGES, (1, 1, 1), (-1, 1, -1)]):
        world.box(
            (0.5, 0.3, 0.4),
            material=white,
            position=np.array(PLACE) + 1.3 * np.array(way) / np.linalg.norm(way),
            axis=(1, 2, index),
            degrees=40 * index,
        )
    lamp = Lamp(cc.PointLight(PLACE, shadow=cc.Shadow(size=512)), shading.Point(PLACE), 2 / 506)
    world.scene.add(lamp.ours)
    eye = (0.3, -0.1, 0.2)
    cube = shared_renderers(None).capture(world.scene, position=eye, size=96)
    hits = with_shapes(capture_hits(world, eye, 96), world.shapes)
    share, same, cosine = around(hits, lamp)
    want = (np.maximum(cosine, 0) * share)[..., None].repeat(3, -1)
    return hits, want, same & inner(hits) & (np.abs(cosine) > 0.1), share, cube.faces[..., :3]


@pytest.mark.slow
@pytest.mark.parametrize("edge", EDGES, ids=str)
def test_no_seam_at_an_edge_of_a_point_lights_cube(cage, edge):
    hits, want, good, share, got = cage
    way = normalised(hits.position - PLACE)
    here = (way @ normalised(edge) > np.cos(np.radians(20))) & (hits.id == 1)
    assert (share[here] == 0).any()
    assert (share[here] == 1).any()
    first, second = (np.abs(way[..., axis]) for axis in range(3) if edge[axis])
    for side in (first > second, second > first):
        assert (good & here & side & (share == 0)).any()
    # These pixels are within a texel or two of the edge itself.
    close = here & (np.abs(first - second) < 0.03)
    assert (close & good).sum() > 3
    assert_close(got, want, "phong", mask=here & good, least=0.001)
    assert_close(got, want, "phong", mask=close & good, least=0.0)


# The filter.


def profile(renderer, shadow, kind="directional"):
    """The share of light on a floor under the shadow of a large board, whose edge crosses it at a slant."""
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(6, 6), cc.PhongMaterial(color=(1, 1, 1), ka=0, ks=0, kd=1))
    board = scene.add(
        cc.Mesh.box((3, 0.1, 3)), cc.PhongMaterial(), position=(0, 2, 0),
        rotation=cc.axis_angle((0, 1, 0), 13),
    )  # fmt: skip
    light = scene.add(
        cc.DirectionalLight((0, -1, -0.1), shadow=shadow)
        if kind == "directional"
        else cc.PointLight((0, 6, 0), shadow=shadow)
    )
    camera = cc.OrthographicCamera(
        height=2, position=(1.7, 1.5, 0), target=(1.7, 0, 0), up=(0, 0, -1)
    )
    dark = renderer.render(scene, camera, (120, 120), format="rgba32f").color[:, :, 0]
    light.shadow = None
    bright = renderer.render(scene, camera, (120, 120), format="rgba32f").color[:, :, 0]
    assert board.id == 2
    return dark / bright


@pytest.mark.parametrize("kind", ["directional", "point"])
def test_the_filter_widens_the_edge_and_keeps_its_place(renderer, kind):
    shares = [profile(renderer, cc.Shadow(size=128, radius=radius), kind) for radius in (0, 1, 3)]
    widths = [((share > 0.02) & (share < 0.98)).sum(axis=1).mean() for share in shares]
    assert widths[0] < 0.6 * widths[1] < 0.5 * widths[2]
    for share in shares:
        assert (share >= 0).all()
        assert (share <= 1).all()
        assert (share == 0).any()
        assert (share == 1).any()
        assert abs(share.mean() - shares[0].mean()) < 0.01
    # The grid of texels alone would give steps; a wide filter makes an even ramp of them.
    assert (np.diff(shares[2], axis=1) > -1e-3).all()


def test_shares_are_continuous(renderer):
    """No step between two pixels is larger than the ramp's slope allows, in a picture of a few texels."""
    share = profile(renderer, cc.Shadow(size=32, radius=1))
    # There are 120 pixels over 2 units and a texel is about 0.2 wide: twelve pixels a texel. The
    # ramp is three texels long.
    assert np.abs(np.diff(share, axis=1)).max() < 2.5 / 36
    assert np.abs(np.diff(share, axis=0)).max() < 2.5 / 36


def test_bias_hides_what_is_near(renderer):
    """A card that hovers over the floor casts a shadow only if it is farther up than the bias."""
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(4, 4), cc.PhongMaterial())
    card = scene.add(cc.Mesh.plane(1, 1), cc.PhongMaterial(), position=(0, 0.3, 0))
    light = scene.add(cc.DirectionalLight((-1, -1, 0)))
    view = perspective((-2, 2, 0.1), (-0.3, 0, 0), size=(32, 24))

    def shadowed(shadow):
        light.shadow = None
        plain = picture(renderer, scene, view)
        light.shadow = shadow
        return (np.abs(picture(renderer, scene, view) - plain) > 0.05).mean()

    assert shadowed(cc.Shadow(size=256)) > 0.03
    assert shadowed(cc.Shadow(size=256, bias=0.4)) > 0.03
    assert shadowed(cc.Shadow(size=256, bias=0.5)) == 0
    card.position = (0, 0.5, 0)
    assert shadowed(cc.Shadow(size=256, bias=0.5)) > 0.03


def test_extent_is_what_a_directional_map_covers(renderer):
    """Outside the extent everything is lit; inside it shadows are as sharp as its texels."""
    scene = cc.Scene()
    floor = scene.add(cc.Mesh.plane(40, 40), cc.PhongMaterial())
    boxes = [scene.add(cc.Mesh.box(0.5), cc.PhongMaterial(), position=(x, 0.5, 0)) for x in (0, 6)]
    light = scene.add(cc.DirectionalLight((-1, -1, 0), shadow=cc.Shadow(size=256, extent=4)))
    views = [
        perspective((box.position[0] - 1, 2, 0.1), (box.position[0] - 0.6, 0, 0), size=(32, 24))
        for box in boxes
    ]
    small = [picture(renderer, scene, view) for view in views]
    light.shadow = None
    plain = [picture(renderer, scene, view) for view in views]
    assert (np.abs(small[0] - plain[0]) > 0.05).mean() > 0.05
    np.testing.assert_allclose(small[1], plain[1], atol=1e-5)
    light.shadow = cc.Shadow(size=256, extent=4)
    floor.cast_shadow = False  # now the casters' middle is between the boxes
    light.shadow = cc.Shadow(size=256)
    assert (np.abs(picture(renderer, scene, views[1]) - plain[1]) > 0.05).mean() > 0.05


@pytest.mark.parametrize("kind", ["spot", "point"])
def test_near_and_far_cut_off_what_casts(renderer, kind):
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(4, 4), cc.PhongMaterial())
    scene.add(cc.Mesh.box(0.4), cc.PhongMaterial(), position=(0, 1, 0))
    light = scene.add(
        cc.PointLight((0, 3, 0)) if kind == "point" else cc.SpotLight((0, 3, 0), angle=50)
    )
    view = perspective((1.5, 1.5, 1.5), (0, 0, 0), size=(32, 24))
    plain = picture(renderer, scene, view)

    def shadowed(**options):
        light.shadow = cc.Shadow(size=256, **options)
        return (np.abs(picture(renderer, scene, view) - plain) > 0.05).any()

    assert shadowed()
    assert shadowed(near=1.7)
    assert shadowed(far=2.3)
    assert shadowed(near=1.7, far=50)
    assert not shadowed(near=2.3)
    assert not shadowed(far=1.7)


@kinds
@pytest.mark.parametrize("offset", [(0, 0, 0), (1e5, -2e4, 3e4)], ids=["here", "far away"])
@pytest.mark.parametrize("scale", [1e-6, 1, 1e4])
def test_size_and_place_of_the_world_do_not_matter(renderer, kind, offset, scale):
    """A scene that is moved and scaled with its lamp and its camera gives the same picture."""
    offset = np.array(offset)

    def drawn(offset, scale):
        world, lamp = stage(), lamps(256, near=0.05 * scale)[kind].ours
        for node in world.scene.nodes:
            node.matrix = ref.trs(offset, scale=scale) @ np.asarray(node.matrix)
        if kind != "directional":
            lamp.position = scale * np.asarray(lamp.position) + offset
        if kind == "spot":
            lamp.decay = 0
        world.scene.add(lamp)
        eye, target = (scale * np.array(p) + offset for p in VIEWS["left"])
        view = perspective(eye, target, size=(48, 36), near=0.1 * scale, far=100 * scale)
        return picture(renderer, world.scene, view)

    difference = np.abs(drawn(offset * scale, scale) - drawn(np.zeros(3), 1)).max(-1)
    assert (difference > 0.01).mean() < 0.01
