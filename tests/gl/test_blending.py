"""Blend modes, depth and colour masks: every mode against its formula, over opaque and translucent grounds."""

import copy
import itertools
import pickle
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.typing import BlendFactor
from tests.compare import assert_close, assert_identical
from tests.reference.compositing import BLENDS, blend

UPRIGHT = cc.axis_angle((1, 0, 0), 90)
CAMERA = cc.PerspectiveCamera(fov=20, target=(0, 0, -1))
GROUNDS = [(0.3, 0.6, 0.9, 1), (0.5, 0.25, 0.75, 0.5), (0, 0, 0, 0)]


def pane(scene, material, z=-2, x=0.0, width=20):
    return scene.add(cc.Mesh.plane(width, 20), material, position=(x, 0, z), rotation=UPRIGHT)


def draw(renderer, scene, size=4, **more):
    return renderer.render(scene, CAMERA, (size, size), format="rgba32f", **more)


@pytest.mark.parametrize("mode", BLENDS)
@pytest.mark.parametrize("ground", GROUNDS)
@pytest.mark.parametrize("alpha", [1, 0.25])
def test_each_mode_is_its_formula(any_path, mode, ground, alpha):
    scene = cc.Scene(background=ground)
    color = (0.9, 0.2, 0.4)
    pane(scene, cc.BasicMaterial(color=color, opacity=alpha, blend=mode))
    got = draw(any_path, scene).color
    assert_close(got, np.broadcast_to(blend(mode, (*color, alpha), ground), got.shape), "blend")


@pytest.mark.parametrize("mode", BLENDS)
def test_the_four_sources_of_alpha_count_alike(renderer, mode):
    """Alpha comes from map, colour and opacity. Only premultiplied map colours already contain the map's alpha."""
    ground, texel = (0.3, 0.6, 0.9, 1), np.array([0.3, 0.2, 0.1, 0.5], np.float32)
    scene = cc.Scene(background=ground)
    material = cc.BasicMaterial(
        color=(0.5, 1, 0.25, 0.5), map=np.full((2, 2, 4), texel), opacity=0.8, blend=mode
    )
    pane(scene, material)
    color = texel[:3] * (0.5, 1, 0.25)
    if mode == "premultiplied":
        source = (*(color * 0.4), 0.5 * 0.4)
        want = np.add(source, np.multiply(ground, 1 - source[3]))
    else:
        want = blend(mode, (*color, 0.5 * 0.4), ground)
    got = draw(renderer, scene).color
    assert_close(got, np.broadcast_to(want, got.shape), "blend")


def walls(turned):
    """Two walls across the line of sight: the farther one shows its back. `turned`: the nearer one is drawn first."""
    corners = np.array([[-9, -9], [9, -9], [9, 9], [-9, 9]], float)
    positions, triangles, colors = [], [], []
    for number, (z, front) in enumerate(((-4, False), (-2, True))):
        positions += [(x, y, z) for x, y in corners]
        order = [[0, 1, 2], [0, 2, 3]] if front else [[0, 2, 1], [0, 3, 2]]
        triangles += [[4 * number + i for i in triangle] for triangle in order]
        colors += [WALLS[number]] * 4
    if turned:
        triangles.reverse()
    return cc.Mesh(positions, triangles, colors=colors)


WALLS = ((0.9, 0.2, 0.1, 0.5), (0.1, 0.7, 0.3, 0.25))


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("kind", [cc.BasicMaterial, cc.StandardMaterial])
def test_backs_of_one_mesh_lie_behind_its_fronts(any_path, turned, mirrored, kind):
    ground = (0.3, 0.6, 0.9, 1)
    scene = cc.Scene(background=ground)
    look = {"unlit": True} if kind is cc.StandardMaterial else {}
    material = kind(vertex_colors=True, double_sided=True, **look)
    scene.add(walls(turned), material, scale=(-1, 1, 1) if mirrored else None)
    want = blend("alpha", WALLS[1], blend("alpha", WALLS[0], ground))
    got = draw(any_path, scene).color
    assert_close(got, np.broadcast_to(want, got.shape), "blend")


def test_each_mesh_with_backs_is_drawn_whole(renderer):
    """Nodes of one mesh and one material are drawn one after the other, each with its backs and fronts."""
    scene = cc.Scene(background=(0, 0, 0, 1))
    material = cc.BasicMaterial(vertex_colors=True, double_sided=True)
    mesh = walls(turned=False)
    for z in (-6, 0):
        scene.add(mesh, material, position=(0, 0, z))
    want = (0, 0, 0, 1)
    for color in WALLS * 2:
        want = blend("alpha", color, want)
    got = draw(renderer, scene).color
    assert_close(got, np.broadcast_to(want, got.shape), "blend")


FACTORS: dict[BlendFactor, Any] = {
    "zero": lambda s, d: np.zeros(4),
    "one": lambda s, d: np.ones(4),
    "src_color": lambda s, d: s,
    "one_minus_src_color": lambda s, d: 1 - s,
    "dst_color": lambda s, d: d,
    "one_minus_dst_color": lambda s, d: 1 - d,
    "src_alpha": lambda s, d: np.full(4, s[3]),
    "one_minus_src_alpha": lambda s, d: np.full(4, 1 - s[3]),
    "dst_alpha": lambda s, d: np.full(4, d[3]),
    "one_minus_dst_alpha": lambda s, d: np.full(4, 1 - d[3]),
    "src_alpha_saturate": lambda s, d: np.array([min(s[3], 1 - d[3])] * 3 + [1]),
}
EQUATIONS = {
    "add": lambda s, d, source, target: s * source + d * target,
    "subtract": lambda s, d, source, target: s * source - d * target,
    "reverse_subtract": lambda s, d, source, target: d * target - s * source,
    "min": lambda s, d, source, target: np.minimum(s, d),
    "max": lambda s, d, source, target: np.maximum(s, d),
}


def blended(factors, source, ground, clamp):
    """The formula of OpenGL 4.5, section 17.3.6. `clamp` is for formats that can hold only values from 0 to 1."""
    s, d = np.array(source, float), np.array(ground, float)
    if clamp:
        s = np.clip(s, 0, 1)
        d = np.round(d * 255) / 255
    source_factor, target_factor = (
        np.append(FACTORS[color](s, d)[:3], FACTORS[alpha](s, d)[3])
        for color, alpha in (
            (factors.src, factors.src_alpha),
            (factors.dst, factors.dst_alpha),
        )
    )
    result = EQUATIONS[factors.equation](s, d, source_factor, target_factor)
    return np.clip(result, 0, 1) if clamp else result


@pytest.mark.parametrize("pixels", ["rgba32f", "rgba8"])
@pytest.mark.parametrize("src", FACTORS)
def test_every_pair_of_factors(renderer, pixels, src):
    source, ground = (1.5, 0.2, 0.4, 0.25), (0.3, 0.6, 0.9, 0.5)
    material = cc.BasicMaterial(color=source)
    scene = cc.Scene(background=ground)
    pane(scene, material)
    for dst in FACTORS:
        material.blend = cc.Blend(src, dst)
        got = renderer.render(scene, CAMERA, (4, 4), format=pixels).color
        want = blended(material.blend, source, ground, pixels == "rgba8")
        check_blended(got, want, f"{src} {dst}")


def check_blended(got, want, what):
    want = np.broadcast_to(want, got.shape)
    try:
        if got.dtype == np.uint8:
            assert_close(got / 255, want, "unorm8_blend")
        else:
            assert_close(got, want, "blend")
    except AssertionError as error:
        raise AssertionError(f"{what}: {error}") from error


@pytest.mark.parametrize("pixels", ["rgba32f", "rgba8"])
@pytest.mark.parametrize("equation", EQUATIONS)
@pytest.mark.parametrize("ground", GROUNDS)
def test_every_equation_with_factors_of_their_own_for_alpha(any_path, pixels, equation, ground):
    source = (0.9, 0.2, 0.4, 0.25)
    scene = cc.Scene(background=ground)
    material = cc.BasicMaterial(color=source[:3], opacity=source[3])
    pane(scene, material)
    pairs: list[tuple[BlendFactor | None, BlendFactor | None]]
    pairs = [("one", "one"), ("dst_alpha", "zero"), (None, None)]
    for src_alpha, dst_alpha in pairs:
        material.blend = cc.Blend(
            "src_alpha", "one", src_alpha=src_alpha, dst_alpha=dst_alpha, equation=equation
        )
        got = any_path.render(scene, CAMERA, (4, 4), format=pixels).color
        check_blended(got, blended(material.blend, source, ground, pixels == "rgba8"), equation)


def test_a_blend_is_drawn_as_what_is_blended_and_leaves_the_next_as_it_is(any_path):
    """The nearest pane is drawn last and uses a named mode: the equation of the pane before does not affect it."""
    scene = cc.Scene(background=(0.5, 0.5, 0.5, 1))
    least = cc.BasicMaterial(color=(0.25, 1, 1), blend=cc.Blend("one", "one", equation="min"))
    pane(scene, least, -3)
    pane(scene, cc.BasicMaterial(color=(0.125, 0, 0), blend="additive"), -2)
    frame = draw(any_path, scene, outputs=("id",))
    assert frame.color[1, 1].tolist() == [0.375, 0.5, 0.5, 2]
    assert (frame.id == 0).all()


def test_a_blend_compares_prints_and_pickles():
    plain = cc.Blend("src_alpha", "one_minus_src_alpha")
    assert repr(plain) == "Blend('src_alpha', 'one_minus_src_alpha')"
    assert (plain.src_alpha, plain.dst_alpha) == ("src_alpha", "one_minus_src_alpha")
    assert plain.equation == "add"
    whole = cc.Blend("one", "dst_color", src_alpha="zero", dst_alpha="one", equation="max")
    assert repr(whole) == (
        "Blend('one', 'dst_color', src_alpha='zero', dst_alpha='one', equation='max')"
    )
    for one in (plain, whole):
        material = cc.PhongMaterial(blend=one)
        assert f"blend={one!r}" in repr(material)
        for copied in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
            assert copied == one
            assert hash(copied) == hash(one)
        for copied in (pickle.loads(pickle.dumps(material)), copy.deepcopy(material)):
            assert copied.blend == one
    assert plain != whole
    assert plain != "alpha"


def test_setting_an_equal_blend_redraws_nothing(fresh_renderer):
    scene = cc.Scene(background=(0.3, 0.6, 0.9, 0.5))
    material = cc.BasicMaterial(color=(1, 0.2, 0.1), blend=cc.Blend("one", "one"))
    pane(scene, material)
    draw(fresh_renderer, scene)
    for made, drawn in ((cc.Blend("one", "one"), 0), (cc.Blend("one", "zero"), 1)):
        material.blend = made
        draw(fresh_renderer, scene)
        assert fresh_renderer.stats.views_drawn == drawn


@pytest.mark.parametrize(
    ("words", "more", "error", "told"),
    [
        (("src", "one"), {}, ValueError, "src: expected 'zero', 'one', .* got 'src'"),
        (("one", "SRC_ALPHA"), {}, ValueError, "dst: expected .* got 'SRC_ALPHA'"),
        (("one", "one"), {"src_alpha": "half"}, ValueError, "src_alpha: expected .* got 'half'"),
        (("one", "one"), {"dst_alpha": 1}, TypeError, "dst_alpha: expected .* got int"),
        (("one", "one"), {"equation": "times"}, ValueError, "equation: expected 'add', .* 'times'"),
        (("one",), {}, TypeError, "dst"),
        (("one", "one", "one"), {}, TypeError, "src_alpha"),
    ],
)
def test_bad_blends_are_told(words, more, error, told):
    with pytest.raises(error, match=told):
        cc.Blend(*words, **more)


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_modes_mix_from_far_to_near(any_path, order):
    layers = [
        ((0.9, 0.1, 0.2), 0.5, "additive", -2),
        ((0.5, 0.8, 0.3), 0.75, "multiply", -3),
        ((0.2, 0.3, 0.9), 0.25, "alpha", -4),
    ]
    scene = cc.Scene(background=(0.4, 0.5, 0.6, 1))
    for color, alpha, mode, z in (layers[i] for i in order):
        pane(scene, cc.BasicMaterial(color=color, opacity=alpha, blend=mode), z)
    want = (0.4, 0.5, 0.6, 1)
    for color, alpha, mode, _ in reversed(layers):
        want = blend(mode, (*color, alpha), want)
    got = draw(any_path, scene).color
    assert_close(got, np.broadcast_to(want, got.shape), "blend")


def test_none_is_alpha_for_what_is_translucent_and_opaque_else(renderer):
    for alpha in (1, 0.5):
        pictures = []
        for mode in (None, "opaque" if alpha == 1 else "alpha"):
            scene = cc.Scene(background=(0.4, 0.5, 0.6, 1))
            pane(scene, cc.BasicMaterial(color=(1, 0.2, 0), opacity=alpha, blend=mode))
            pictures.append(draw(renderer, scene, outputs=("id",)))
        assert_identical(pictures[0].color, pictures[1].color)
        assert (pictures[0].id == (1 if alpha == 1 else 0)).all()


def test_opaque_ignores_alpha(renderer):
    scene = cc.Scene(background=(0.4, 0.5, 0.6, 0.5))
    pane(scene, cc.BasicMaterial(color=(1, 0.2, 0), opacity=0.3, blend="opaque"))
    frame = draw(renderer, scene, outputs=("id",))
    assert_close(frame.color, np.broadcast_to([1, 0.2, 0, 1], frame.color.shape), "blend")
    assert (frame.id == 1).all()


def test_depth_write_hides_what_is_farther(any_path):
    """Two additive panes cross: when the one drawn first writes depth, it hides the other where it is nearer."""
    scene = cc.Scene(background=(0, 0, 0, 1))
    glow = cc.BasicMaterial(color=(1, 0, 0), blend="additive", double_sided=True)
    other = cc.BasicMaterial(color=(0, 1, 0), blend="additive", double_sided=True)
    # Two panes cross. Their centres are equally far, so the pane with the lower id is drawn first.
    for material, turn in ((glow, 60), (other, -60)):
        quad = cc.Mesh([(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], [(0, 1, 2), (0, 2, 3)])
        scene.add(quad, material, position=(0, 0, -6), rotation=cc.axis_angle((0, 1, 0), turn))
    both = draw(any_path, scene, 16).color
    assert (both[8, 3:13, :2] == 1).all()
    glow.depth_write = True
    got = draw(any_path, scene, 16).color
    green = got[8, :, 1]
    # Where the first pane is nearer, it hides the second: on one side of the crossing only.
    assert sorted({tuple(green[4:7]), tuple(green[9:12])}) == [(0, 0, 0), (1, 1, 1)]


def test_opaque_without_depth_is_drawn_over_the_background_and_hides_nothing(any_path):
    scene = cc.Scene(background=cc.CubeMap(np.full((6, 4, 4, 3), 0.5, np.float32)))
    ghost = cc.BasicMaterial(color=(1, 0, 0), depth_write=False)
    pane(scene, ghost, -2, x=-5.2, width=10)
    solid = pane(scene, cc.BasicMaterial(color=(0, 0, 1)), -3)
    frame = draw(any_path, scene, 8, outputs=("id",))
    assert (frame.color[:, 0] == (1, 0, 0, 1)).all()
    assert (frame.color[:, -1] == (0, 0, 1, 1)).all()
    assert (frame.id == solid.id).all(), "what leaves no depth leaves no id"
    solid.position = (0, 0, -1.5)
    assert (draw(any_path, scene, 8).color == (0, 0, 1, 1)).all(), "it is hidden by what is nearer"


def test_without_depth_test_it_shows_through_what_is_nearer(any_path):
    scene = cc.Scene()
    pane(scene, cc.BasicMaterial(color=(0, 0, 1)), -2)
    marker = pane(scene, cc.BasicMaterial(color=(1, 0, 0), depth_test=False), -5)
    assert (draw(any_path, scene).color == (1, 0, 0, 1)).all()
    marker.material.depth_test = True
    assert (draw(any_path, scene).color == (0, 0, 1, 1)).all()


@pytest.mark.parametrize("mask", list(itertools.product([True, False], repeat=4)))
def test_color_write_chooses_channels(any_path, mask):
    ground, color = (0.3, 0.6, 0.9, 0.5), (0.8, 0.1, 0.2, 1)
    scene = cc.Scene(background=ground)
    pane(scene, cc.BasicMaterial(color=color[:3], color_write=mask))
    frame = draw(any_path, scene, outputs=("distance", "id"))
    want = np.where(mask, color, ground)
    assert_close(frame.color, np.broadcast_to(want, frame.color.shape), "blend")
    assert (frame.id == 1).all()
    assert np.isfinite(frame.distance).all()


def test_a_mask_does_not_leak_to_the_next_node_or_frame(any_path):
    scene = cc.Scene(background=(0, 0, 0, 1))
    pane(scene, cc.BasicMaterial(color=(1, 1, 1), color_write=False), -2, x=-5.2, width=10)
    pane(scene, cc.BasicMaterial(color=(0, 1, 0)), -3, x=5.2, width=10)
    pane(
        scene,
        cc.BasicMaterial(color=(1, 0, 0), opacity=0.5, color_write=(True, False, False, True)),
        -4,
    )
    color = draw(any_path, scene, 8).color
    assert_close(color[:, -1], np.broadcast_to([0, 1, 0, 1], (8, 4)), "blend")
    assert_close(color[:, 0], np.broadcast_to([0, 0, 0, 1], (8, 4)), "blend")
    plain = cc.Scene(background=(0.5, 0.5, 0.5, 1))
    assert (draw(any_path, plain).color == (0.5, 0.5, 0.5, 1)).all()


def test_a_holdout_hides_in_captures(any_path):
    """A holdout writes depth but no colour: the background shows where it stands in front of a wall."""
    scene = cc.Scene(background=(0.25, 0.5, 0.75, 1))
    scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color_write=False), position=(0, 0, -1))
    scene.add(cc.Mesh.box((6, 6, 0.1)), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, -2))
    cube = any_path.capture(scene, size=9, outputs=("id",))
    assert cube.faces[5, 4, 4].tolist() == [0.25, 0.5, 0.75, 1]
    assert cube.id[5, 4, 4] == 1
    assert cube.faces[5, 0, 0].tolist() == [1, 0, 0, 1]


def test_every_setting_redraws_and_equal_ones_do_not(fresh_renderer):
    scene = cc.Scene(background=(0.3, 0.6, 0.9, 0.5))
    material = cc.BasicMaterial(color=(1, 0.2, 0.1), opacity=0.5)
    pane(scene, material)
    draw(fresh_renderer, scene)
    changes = [
        ("blend", "additive"),
        ("depth_write", True),
        ("depth_test", False),
        ("color_write", (True, False, True, True)),
    ]
    for name, value in changes:
        setattr(material, name, value)
        got = draw(fresh_renderer, scene)
        assert fresh_renderer.stats.views_drawn == 1, name
        setattr(material, name, value)
        again = draw(fresh_renderer, scene)
        assert fresh_renderer.stats.views_drawn == 0, name
        assert_identical(got.color, again.color)


@pytest.mark.parametrize(
    "kind", [cc.BasicMaterial, cc.PhongMaterial, cc.MirrorMaterial, cc.GlassMaterial]
)
def test_every_material_has_them_and_pickles_them(kind):
    material = kind(
        blend="multiply", depth_write=True, depth_test=False, color_write=(True, False, True, False)
    )
    for copied in (pickle.loads(pickle.dumps(material)), copy.deepcopy(material)):
        assert copied.blend == "multiply"
        assert copied.depth_write is True
        assert copied.depth_test is False
        assert copied.color_write == (True, False, True, False)
    fresh = kind()
    assert (fresh.blend, fresh.depth_write, fresh.depth_test) == (None, None, True)
    assert fresh.color_write == (True,) * 4
    fresh.color_write = False
    assert fresh.color_write == (False,) * 4
    assert "blend='multiply'" in repr(material)


@pytest.mark.parametrize(
    ("name", "value", "error", "told"),
    [
        (
            "blend",
            "screen",
            ValueError,
            "'opaque', 'alpha', 'alpha_keep', 'additive', 'multiply', 'premultiplied'",
        ),
        ("blend", 1, TypeError, "blend: expected the name of a mode, a Blend or None, got int"),
        ("depth_write", "yes", TypeError, "depth_write: expected True, False or None, got str"),
        ("color_write", (True, False), ValueError, "expected a bool or four .* got 2 values"),
        ("color_write", (1.0, 0, 0, 0), TypeError, "color_write: expected a bool or four"),
        ("color_write", "rgba", TypeError, "color_write: expected a bool or four"),
    ],
)
def test_bad_settings_are_told_and_change_nothing(name, value, error, told):
    with pytest.raises(error, match=told):
        cc.PhongMaterial(**{name: value})
    material = cc.PhongMaterial()
    before = getattr(material, name)
    with pytest.raises(error, match=told):
        setattr(material, name, value)
    assert getattr(material, name) == before
