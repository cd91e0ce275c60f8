"""What casts shadows and on what, the maps themselves, what is drawn again and what is not, and limits."""

import copy
import itertools
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.shadows import lamps, stage
from tests.gl.world import World, perspective
from tests.reference import raycast
from tests.reference import transforms as ref
from tests.reference.cube_faces import texel_directions

kinds = pytest.mark.parametrize("kind", ["directional", "spot", "point"])
LAYERS = {"directional": 1, "spot": 1, "point": 6}
#: This view shows only the part of the floor where the shadow falls.
VIEW = perspective((-2.5, 1, 0.1), (-1, 0, 0), fov=25, size=(32, 24))


def hovering(kind="directional", **options):
    """A floor, a box over it that the camera does not see, and a light from the upper right."""
    scene = cc.Scene()
    shadow = cc.Shadow(size=128, **options)
    floor = scene.add(cc.Mesh.plane(8, 6), cc.PhongMaterial(ks=0), name="floor")
    box = scene.add(cc.Mesh.box(0.8), cc.PhongMaterial(), position=(0.2, 1.2, 0), name="box")
    light = {
        "directional": lambda: cc.DirectionalLight((-1, -1, 0), shadow=shadow),
        "spot": lambda: cc.SpotLight((2, 3, 0), (-2, -2, 0), angle=50, shadow=shadow),
        "point": lambda: cc.PointLight((2, 3, 0), shadow=shadow),
    }[kind]()
    scene.add(light)
    return scene, floor, box, light


def picture(renderer, scene, view=VIEW, **options):
    return renderer.render(scene, view.camera, view.size, format="rgba32f", **options).color


def dark(renderer, scene, view=VIEW):
    """The share of the picture that lies in shadow, where only ambient light arrives."""
    return (picture(renderer, scene, view)[..., 0] < 0.21).mean()


# Which nodes cast shadows, and on which nodes.


@kinds
def test_what_is_out_of_view_casts_all_the_same(renderer, kind):
    scene, *_ = hovering(kind)
    assert dark(renderer, scene) > 0.1


def show_a_card_from_below(node):
    node.mesh = cc.Mesh.plane(1, 1)
    node.rotation = cc.axis_angle((1, 0, 0), 180)


def write_nothing(material):
    material.depth_write = material.color_write = False


CASTING = {
    "hidden": (lambda s, box: setattr(box, "visible", False), False),
    "parent hidden": (lambda s, box: setattr(box, "parent", s.add(visible=False)), False),
    "translucent": (lambda s, box: setattr(box.material, "opacity", 0.5), False),
    "translucent map": (
        lambda s, box: setattr(box.material, "map", np.full((2, 2, 4), 99, np.uint8)),
        False,
    ),
    "casts no shadows": (lambda s, box: setattr(box, "cast_shadow", False), False),
    "below one that casts none": (
        lambda s, box: setattr(box, "parent", s.add(cast_shadow=False)),
        False,
    ),
    "removed": (lambda s, box: s.remove(box), False),
    "receives none": (lambda s, box: setattr(box, "receive_shadow", False), True),
    "out of probes": (lambda s, box: setattr(box, "in_captures", False), True),
    "unlit": (lambda s, box: setattr(box, "material", cc.BasicMaterial()), True),
    "mirror": (lambda s, box: setattr(box, "material", cc.MirrorMaterial()), True),
    "glass": (lambda s, box: setattr(box, "material", cc.GlassMaterial()), True),
    "writes no depth": (lambda s, box: setattr(box.material, "depth_write", False), True),
    "writes no colour": (lambda s, box: setattr(box.material, "color_write", False), True),
    "writes neither": (lambda s, box: write_nothing(box.material), True),
    "additive": (lambda s, box: setattr(box.material, "blend", "additive"), False),
    "inside out": (lambda s, box: setattr(box, "scale", (-1, 1, 1)), True),
    "a card from above": (lambda s, box: setattr(box, "mesh", cc.Mesh.plane(1, 1)), True),
    "a card from below": (
        lambda s, box: show_a_card_from_below(box),
        True,
    ),
}


@kinds
@pytest.mark.parametrize(("change", "casts"), CASTING.values(), ids=CASTING)
def test_what_casts(renderer, fresh_renderer, kind, change, casts):
    """Every visible opaque node casts, from either side; a renderer that holds an older map sees the change."""
    scene, _, box, _ = hovering(kind)
    before = picture(renderer, scene)
    change(scene, box)
    after = picture(renderer, scene)
    assert (dark(renderer, scene) > 0.03) == casts
    if not casts:
        assert (after != before).any()
    assert_identical(after, picture(fresh_renderer, scene))


#: Every combination of what could decide whether a surface casts, and many that must not.
SURFACES = list(
    itertools.product(
        (None, "opaque", "alpha", "additive"),  # blend
        (1, 0.5),  # opacity
        (None, False, True),  # depth_write
        (True, False, (True, False, True, True)),  # color_write
        (True, False),  # depth_test
        (None, cc.Stencil(depth_pass="replace")),
    )
)


def is_opaque(material):
    return material.blend == "opaque" or (material.blend is None and material.opacity == 1)


@kinds
def test_a_map_does_not_depend_on_the_map_before(renderer, fresh_renderer, kind):
    """Whatever a surface was before: it casts if it is opaque, and the map is that of another renderer.

    Both boxes change, so that the bounds of a directional light's casters change, too.
    """
    rng = np.random.default_rng(31)
    scene, floor, box, light = hovering(kind)
    floor.cast_shadow = False
    light.shadow = cc.Shadow(size=24)
    other = scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(), position=(-1.5, 0.5, 0.4))
    outlines: dict[tuple[bool, ...], np.ndarray] = {}
    names = ("blend", "opacity", "depth_write", "color_write", "depth_test", "stencil")
    for choice in rng.permutation(len(SURFACES)):
        node = (box, other)[rng.integers(2)]
        for name, value in zip(names, SURFACES[choice], strict=True):
            setattr(node.material, name, value)
        got = renderer.shadow_map(scene, light)
        again = copy.deepcopy(scene)
        want = fresh_renderer.shadow_map(again, again.lights[0])
        assert_identical(got, want, str(SURFACES[choice]))
        casting = tuple(is_opaque(n.material) for n in (box, other))
        assert np.isfinite(got).any() == any(casting)
        assert_identical(got, outlines.setdefault(casting, got), "equal casters, equal maps")
    assert len(outlines) == 4


@pytest.mark.parametrize("options", [{"opacity": 0.5}, {"blend": "multiply", "depth_write": True}])
def test_what_casts_no_shadow_does_not_widen_a_map(renderer, options):
    """The map of a directional light is as wide as the bounds of its casters, and no wider."""
    scene, _, _, light = hovering()
    want = renderer.shadow_map(scene, light)
    scene.add(cc.Mesh.box(50), cc.PhongMaterial(**options), position=(30, 3, 0))
    assert_identical(renderer.shadow_map(scene, light), want)


def test_what_receives(renderer):
    scene, floor, box, light = hovering()
    floor.receive_shadow = False
    assert dark(renderer, scene) == 0
    light.shadow = None
    plain = picture(renderer, scene)
    light.shadow = True
    np.testing.assert_allclose(picture(renderer, scene), plain, atol=1e-6)
    floor.receive_shadow = True
    assert dark(renderer, scene) > 0.1
    floor.material.opacity = 0.999  # translucent things cast no shadows, but show them
    assert dark(renderer, scene) > 0.1
    # receive_shadow is not inherited: the child of a node without it receives shadows.
    floor.parent = box.parent = scene.add(receive_shadow=False)
    assert dark(renderer, scene) > 0.1
    floor.material = cc.BasicMaterial(color=(1, 1, 1))
    assert dark(renderer, scene) == 0


def test_shadows_belong_to_the_scene_and_not_to_the_picture(renderer):
    """A node left out of a capture, of all probes or of its own probe still casts shadows there."""
    scene, _, box, light = hovering()
    light.shadow = cc.Shadow(size=256)
    where = {"position": (-1.7, 1.2, 0), "size": 32}
    whole = renderer.capture(scene, **where).faces[3]
    assert 0.1 < (whole[..., 0] < 0.21).mean() < 1
    assert_identical(renderer.capture(scene, exclude=[box], **where).faces[3], whole)
    box.in_captures = False
    assert_identical(renderer.capture(scene, **where).faces[3], whole)
    box.in_captures = True
    box.material = cc.MirrorMaterial()
    box.environment = probe = cc.Probe(position=(-1.7, 1.2, 0), size=32, format="rgba32f")
    renderer.update_probes(scene)
    np.testing.assert_allclose(renderer.read_probe(probe).faces[3], whole, atol=1e-6)


@kinds
def test_a_caster_that_moves_out_of_view_moves_its_shadow(renderer, fresh_renderer, kind):
    """The shadow moves with the caster; without a change neither map nor picture is drawn again."""
    scene, _, box, _ = hovering(kind)
    first = picture(renderer, scene)
    assert renderer.stats.shadow_views_drawn == LAYERS[kind]
    assert renderer.stats.views_drawn == 1
    assert_identical(picture(renderer, scene), first)
    assert (renderer.stats.shadow_views_drawn, renderer.stats.views_drawn) == (0, 0)
    assert renderer.stats.draw_calls == 0
    box.position = (0.3, 1.2, 0.1)
    moved = picture(renderer, scene)
    assert renderer.stats.views_drawn == 1
    assert 0 < renderer.stats.shadow_views_drawn < 3
    assert (moved != first).any()
    assert_identical(moved, picture(fresh_renderer, scene))
    box.position = (0.2, 1.2, 0)
    assert_identical(picture(renderer, scene), first)


def test_only_the_layers_that_see_a_change_are_drawn(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.plane(20, 20), cc.PhongMaterial(), position=(0, -3, 0))
    boxes = [
        scene.add(cc.Mesh.box(0.5), cc.PhongMaterial(), position=place)
        for place in ((3, 0, 0), (-3, 0, 0), (0, 3, 0), (0, 0, 3), (0, 0, -3))
    ]
    scene.add(cc.PointLight(shadow=cc.Shadow(size=64)))
    picture(renderer, scene)
    for box in boxes:
        box.position = np.array(box.position) * 1.1
        picture(renderer, scene)
        assert renderer.stats.shadow_views_drawn == 1


@kinds
def test_what_a_map_does_not_hang_on(renderer, kind):
    """No map is drawn again when a camera, a capture, a colour or the background changes."""
    scene, floor, _, light = hovering(kind)
    picture(renderer, scene)
    for change in (
        lambda: setattr(light, "color", (1, 0.5, 0.2)),
        lambda: setattr(light, "intensity", 2),
        lambda: setattr(floor.material, "color", (1, 0, 0)),
        lambda: setattr(floor, "receive_shadow", True),
        lambda: setattr(scene, "background", (0.1, 0.2, 0.3)),
        lambda: setattr(light, "shadow", cc.Shadow(size=128, bias=0.01)),
        lambda: setattr(light, "shadow", cc.Shadow(size=128, bias=0.01)),
        lambda: scene.add(cc.Mesh.box(1), cc.BasicMaterial(), position=(9, 0, 0), visible=False),
    ):
        change()
        picture(renderer, scene, perspective((1, 4, 1), (0, 0, 0)))
        renderer.capture(scene, position=(-1, 0.5, 0), size=8)
        assert renderer.stats.shadow_views_drawn == 0
    light.shadow = cc.Shadow(size=64)
    picture(renderer, scene)
    assert renderer.stats.shadow_views_drawn == LAYERS[kind]


CHANGES = {
    "size": lambda light, box: setattr(light, "shadow", cc.Shadow(size=64)),
    "radius": lambda light, box: setattr(light, "shadow", cc.Shadow(size=128, radius=3)),
    "bias": lambda light, box: setattr(light, "shadow", cc.Shadow(size=128, bias=1.8)),
    "none": lambda light, box: setattr(light, "shadow", None),
    "mesh": lambda light, box: setattr(box, "mesh", cc.Mesh.sphere(0.4)),
    "turn": lambda light, box: setattr(box, "rotation", cc.axis_angle((0, 1, 0), 45)),
    "scale": lambda light, box: setattr(box, "scale", 1.3),
    "parent": lambda light, box: setattr(box, "parent", box.parent.children[-1]),
}


@kinds
@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_every_change_is_seen(renderer, fresh_renderer, kind, change):
    scene, _, box, light = hovering(kind)
    box.parent = scene.add()
    scene.add(position=(0, 0, 0.3), parent=box.parent)
    before = picture(renderer, scene)
    change(light, box)
    after = picture(renderer, scene)
    assert renderer.stats.views_drawn == 1
    assert (after != before).any()
    assert_identical(after, picture(fresh_renderer, scene))


@pytest.mark.parametrize(
    ("kind", "name", "value"),
    [
        ("spot", "angle", 35),
        ("spot", "penumbra", 0.9),
        ("spot", "direction", (-2, -2, 0.2)),
        ("spot", "position", (2, 3.1, 0)),
        ("spot", "decay", 1),
        ("point", "position", (2, 3.1, 0)),
        ("directional", "direction", (-1, -1, 0.1)),
    ],
)
def test_every_change_of_the_light_is_seen(renderer, fresh_renderer, kind, name, value):
    scene, _, _, light = hovering(kind)
    before = picture(renderer, scene)
    setattr(light, name, value)
    after = picture(renderer, scene)
    assert (after != before).any()
    assert_identical(after, picture(fresh_renderer, scene))


def test_a_light_in_two_scenes(renderer, fresh_renderer):
    """A light in two scenes has a map of each scene, also when they are drawn in turns."""
    scene, _, _, light = hovering("point")
    other = cc.Scene()
    other.add(cc.Mesh.plane(8, 6), cc.PhongMaterial(ks=0))
    other.add(light)
    for _ in range(2):
        assert dark(renderer, scene) > 0.1
        assert dark(renderer, other) == 0
    assert_identical(picture(renderer, scene), picture(fresh_renderer, scene))


def test_nothing_is_drawn_for_what_receives_nothing(renderer):
    scene, floor, box, _ = hovering()
    floor.material = box.material = cc.BasicMaterial()
    picture(renderer, scene)
    assert renderer.stats.shadow_views_drawn == 0


def test_all_kinds_of_light_layered_and_one_by_one(new_renderer):
    world = stage()
    for lamp in lamps(64).values():
        world.scene.add(lamp.ours)
    one, other = new_renderer(layered=True), new_renderer(layered=False)
    for options in ({}, {"samples": 4}):
        a, b = (
            r.capture(world.scene, position=(0, 1, 2), size=24, **options) for r in (one, other)
        )
        assert_identical(a.faces, b.faces, across="programs")


# The maps themselves.


def test_a_spot_lights_map(renderer):
    """The map holds distances along the axis, as a camera at the light sees them, with row 0 on top."""
    world, size = stage(), 64
    lamp = lamps(size)["spot"].ours
    world.scene.add(lamp)
    got = renderer.shadow_map(world.scene, lamp)
    assert got.shape == (1, size, size)
    assert got.dtype == np.float32
    place, way = np.asarray(lamp.position), np.asarray(lamp.direction)
    view = ref.look_at(place, place + way, (0, 1, 0))
    half = np.tan(np.radians(38)) * size / (size - 6)
    lens = ref.perspective(2 * np.degrees(np.arctan(half)), 1, 0.05, 100)
    origins, directions = ref.pixel_rays(view, lens, (size, size))
    compare_map(got[0], world, origins, directions, way)


def compare_map(got, world, origins, directions, axis, start=0.0):
    for shape in world.shapes:
        shape.double_sided = True
    hits = raycast.cast(world.shapes, origins, directions)
    want = np.where(hits.hit, ((hits.position - origins) * axis).sum(-1) - start, np.inf)
    mask = raycast.interior(hits.id, hits.part)
    assert np.isinf(want[mask]).any() or np.isfinite(want).all()
    assert_close(got, want, "distance", mask=mask, least=0.3)


def test_a_point_lights_map(renderer):
    """The map holds six views, in the order and the layout of a capture's faces."""
    world, size = stage(), 64
    lamp = lamps(size)["point"].ours
    world.scene.add(lamp)
    got = renderer.shadow_map(world.scene, lamp)
    assert got.shape == (6, size, size)
    wide = size / (size - 6)
    for face in range(6):
        directions = texel_directions(size)[face]
        axis = np.where(np.abs(directions.mean((0, 1))) > 0.5, directions.mean((0, 1)), 0)
        directions = axis + wide * (directions - axis)
        compare_map(got[face], world, np.asarray(lamp.position), directions, axis)


def test_a_directional_lights_map(renderer):
    """The map covers an extent of 5 around the middle of the casters; its outermost texels are empty.

    Distances are measured from where the casters begin.
    """
    world, size = World(), 66
    solid = cc.PhongMaterial(double_sided=True)
    world.plane(6, 4, material=solid, position=(0.5, 0, 0.25))
    world.box((1, 1, 0.5), material=solid, position=(1, 2, 0))
    world.box((0.5, 0.5, 0.5), material=solid, position=(-1, 1, 1))
    light = world.scene.add(cc.DirectionalLight((0, -1, 0), shadow=cc.Shadow(size=size, extent=5)))
    got = renderer.shadow_map(world.scene, light)
    assert got.shape == (1, size, size)
    edge = np.ones((size, size), bool)
    edge[1:-1, 1:-1] = False
    assert np.isinf(got[0][edge]).all()
    # The light looks down: -Z is up in the map, +X to the right, the floor's middle in the middle.
    step = (np.arange(64) + 0.5) / 64 * 5 - 2.5
    x, z = np.meshgrid(0.5 + step, 0.25 + step)
    origins = np.stack([x, np.full_like(x, 3.5), z], axis=-1)
    compare_map(
        got[0, 1:-1, 1:-1],
        world,
        origins,
        np.broadcast_to([0.0, -1, 0], origins.shape),
        [0, -1, 0],
        start=1,
    )


def test_a_directional_map_holds_all_casters(renderer):
    """The map holds every caster for any place and size of casters and any camera, also one flat caster."""
    for direction in ((-1, -2, 0.5), (0, 1, 0), (1, 0, 0), (0.3, -0.1, 5)):
        scene = cc.Scene()
        light = scene.add(cc.DirectionalLight(direction, shadow=cc.Shadow(size=64)))
        for place, size in (((5, 1, -3), 1), ((-40, 2, 7), 3)):
            scene.add(cc.Mesh.box(size), position=place, rotation=cc.axis_angle((1, 2, 3), 50))
        depth = renderer.shadow_map(scene, light)
        inside = np.isfinite(depth[0, 1:-1, 1:-1])
        assert inside.sum() > 3
        assert depth.min() >= 0
        assert depth[np.isfinite(depth)].max() < 60
        scene = cc.Scene()
        scene.add(light)
        scene.add(cc.Mesh.plane(2, 2))
        assert np.isfinite(renderer.shadow_map(scene, light)).any() == (direction[1] != 0)


def test_a_scene_without_casters_is_lit(renderer):
    scene, floor, box, light = hovering()
    for node in (floor, box):
        node.cast_shadow = False
    for kind in (
        light,
        cc.PointLight((0, 3, 0), shadow=True),
        cc.SpotLight((0, 3, 0), shadow=True),
    ):
        if kind not in scene:
            scene.add(kind)
        assert np.isinf(renderer.shadow_map(scene, kind)).all()
    assert dark(renderer, scene) == 0


def test_shadow_map_refuses_what_has_none(renderer):
    scene, *_ = hovering()
    with pytest.raises(ValueError, match="expected a light of this scene"):
        renderer.shadow_map(scene, cc.PointLight(shadow=True))
    for light in (cc.PointLight(), cc.AmbientLight()):
        scene.add(light)
        with pytest.raises(ValueError, match="expected one with a shadow"):
            renderer.shadow_map(scene, light)
    with pytest.raises(TypeError):
        renderer.shadow_map(scene, scene.nodes[0])


def test_a_map_shows_casters_where_a_render_texture_moves_them(renderer):
    """The texture is updated before the map, also when only the map is read."""
    moved = """uniform sampler2D t;
    void vertex(inout Vertex v) { v.position.x += textureLod(t, vec2(0.5), 0.0).r; }"""
    red = cc.Scene(background=(0.25, 0, 0, 1))
    texture = cc.RenderTexture(red, cc.PerspectiveCamera(), size=(4, 4), format="rgba32f")
    material = cc.ShaderMaterial(
        "vec3 shade(Surface s) { return vec3(1); }", vertex=moved, textures={"t": texture}
    )
    lamp = cc.PointLight((0, 3, 0), shadow=cc.Shadow(size=32))
    scene = cc.Scene()
    scene.add(lamp)
    scene.add(cc.Mesh.box(0.8), material)
    for x, drawn in ((0.25, 1), (0.25, 0), (-0.5, 1)):
        red.background = (x, 0, 0, 1)
        got = renderer.shadow_map(scene, lamp)
        assert (renderer.stats.textures_updated, renderer.stats.shadow_views_drawn > 0) == (
            drawn,
            drawn == 1,
        )
        plain = cc.Scene()
        plain.add(lamp)
        plain.add(cc.Mesh.box(0.8), position=(x, 0, 0))
        want = renderer.shadow_map(plain, lamp)
        assert np.isfinite(want).any()
        assert_close(1 / got, 1 / want, "float32_maths")
        renderer.shadow_map(scene, lamp)


# Limits.


def test_a_size_beyond_the_driver_is_refused(renderer):
    scene, _, _, light = hovering()
    largest = renderer.info.limits.max_texture_size
    light.shadow = cc.Shadow(size=largest + 1)
    for call in (
        lambda: picture(renderer, scene),
        lambda: renderer.capture(scene, size=8),
        lambda: renderer.shadow_map(scene, light),
    ):
        with pytest.raises(ValueError, match=f"at most {largest} texels .GL_MAX_TEXTURE_SIZE"):
            call()
    light.shadow = cc.Shadow(size=128)
    assert dark(renderer, scene) > 0.1


def test_sixteen_lights_have_shadows_and_a_seventeenth_is_refused(renderer):
    scene, _, _, light = hovering()
    for index in range(15):
        scene.add(
            cc.PointLight((2, 3, index - 7), intensity=0, shadow=cc.Shadow(size=16, radius=0))
            if index % 2
            else cc.DirectionalLight((-1, -1, index), intensity=0, shadow=cc.Shadow(size=16))
        )
    assert dark(renderer, scene) > 0.1
    light.intensity = 0
    last = scene.lights[-1]
    last.intensity = 1
    last.direction = (-1, -1, 0)
    last.shadow = cc.Shadow(size=256)
    assert dark(renderer, scene) > 0.03
    scene.add(cc.SpotLight(shadow=True))
    with pytest.raises(
        ValueError, match=r"at most 16 with a shadow .*GL_MAX_TEXTURE_IMAGE_UNITS.* got 17"
    ):
        picture(renderer, scene)


@kinds
def test_the_smallest_map_and_the_widest_filter(renderer, kind):
    scene, _, _, light = hovering(kind)
    for shadow in (
        cc.Shadow(size=8, radius=0),
        cc.Shadow(size=72, radius=16),
        cc.Shadow(size=33, radius=0.3),
    ):
        light.shadow = shadow
        color = picture(renderer, scene)[..., 0]
        assert np.isfinite(color).all()
        assert 0.1 < color.min() < 1
        assert color.min() < color.max() or shadow.size == 8


def test_lights_in_odd_places(renderer):
    """Lights on a surface, in a mesh's corner, far away or at the camera give finite values and no crash."""
    scene, _, _, _ = hovering()
    for light in (
        cc.PointLight((0, 0, 0), shadow=cc.Shadow(size=32)),
        cc.PointLight((0.6, 1.6, 0.4), shadow=cc.Shadow(size=32, near=1e-6)),
        cc.PointLight((1e7, 1e7, 0), shadow=cc.Shadow(size=32)),
        cc.PointLight((-2.5, 1, 0.1), shadow=cc.Shadow(size=32, near=1e-30, far=1e30)),
        cc.SpotLight((0, 0.01, 0), (1, 0, 0), angle=89.99, shadow=cc.Shadow(size=32)),
        cc.SpotLight((0, 3, 0), (1e-30, -1e-30, 0), angle=1e-3, shadow=cc.Shadow(size=32)),
        cc.DirectionalLight((1, 0, 0), shadow=cc.Shadow(size=32, extent=1e-20)),
        cc.DirectionalLight((0, 1, 0), shadow=cc.Shadow(size=32, extent=1e20)),
    ):
        scene.add(light)
        assert np.isfinite(picture(renderer, scene)).all()
        assert not np.isnan(renderer.shadow_map(scene, light)).any()
        scene.remove(light)


def test_maps_go_with_their_lights(renderer):
    """Lights that came and went leave no memory."""
    scene, _, _, light = hovering()
    scene.remove(light)

    def come_and_go(count):
        for index in range(count):
            light = scene.add(cc.PointLight((2, 3, index / 100), shadow=cc.Shadow(size=512)))
            picture(renderer, scene)
            scene.remove(light)
        del light
        return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

    before = come_and_go(10)
    assert come_and_go(30) - before < 48 << 20  # thirty maps are 190 MB
