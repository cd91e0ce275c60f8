"""Shadows of surfaces with holes: alpha_mode="mask" leaves out of a shadow what it leaves out of the picture."""

from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import DEVICE

CELLS = np.random.default_rng(5).random((6, 6)) < 0.5
ALPHA = np.where(CELLS, 0.7, 0.3)
WIDE = 64
SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)


def picture(alpha=ALPHA, **options):
    """An image whose alpha is that of the cells, row 0 on top."""
    pixels = np.ones((*alpha.shape, 4), np.float32)
    pixels[..., 3] = alpha
    return cc.Image(pixels, mag_filter="nearest", min_filter="nearest", **options)


def sheet(uvs=SQUARE, **more):
    """A square over x, z = 0..6 at y = 1, which looks up; u goes with x, and v against z."""
    positions = [[0, 1, 6], [6, 1, 6], [6, 1, 0], [0, 1, 0]]
    return cc.Mesh(positions, [[0, 1, 2], [0, 2, 3]], uvs=uvs, **more)


def stage(mesh, material, light=None):
    """A floor that the sun lights straight from above, under the sheet."""
    scene = cc.Scene()
    scene.add(light or cc.DirectionalLight((0, -1, 0), shadow=cc.Shadow(size=512, radius=1)))
    scene.add(cc.Mesh.box((6, 0.1, 6)), cc.PhongMaterial(ka=0, kd=1, ks=0), position=(3, -0.05, 3))
    scene.add(mesh, material, name="sheet")
    return scene


#: It sees the floor from below the sheet; row 0 is at z = 0.
CAMERA = cc.OrthographicCamera(height=6, position=(3, 0.5, 3), target=(3, 0, 3), up=(0, 0, -1))


def lit(renderer, scene):
    return renderer.render(scene, CAMERA, (WIDE, WIDE), format="rgba32f").color[..., 0]


def check(renderer, scene, solid):
    """Whether the floor is dark below the solid cells of an array (row 0 at z = 0), away from their edges."""
    got = lit(renderer, scene)
    at = (np.arange(WIDE) + 0.5) / WIDE * len(solid)
    inside = np.abs(at - np.round(at)) > 0.08
    want = ~solid[np.ix_(at.astype(int), at.astype(int))]
    mask = np.ix_(inside, inside)
    np.testing.assert_allclose(got[mask], want[mask].astype(float), atol=0.01)


def masked(**options):
    return cc.StandardMaterial(alpha_mode="mask", double_sided=True, **options)


def test_the_shadow_has_the_holes_of_the_map(any_path):
    check(any_path, stage(sheet(), masked(map=picture())), CELLS)


@pytest.mark.parametrize("mode", ["opaque", None])
def test_without_a_mask_there_are_none(renderer, mode):
    solid = picture(np.ones((6, 6)))
    material = cc.StandardMaterial(alpha_mode=mode, map=picture() if mode else solid)
    check(renderer, stage(sheet(), material), np.ones((6, 6), bool))


@pytest.mark.parametrize("kind", ["point", "spot"])
def test_lamps(renderer, kind):
    """The sheet lies half way between lamp and floor, so that its shadow is twice as large."""
    shadow = cc.Shadow(size=512)
    light = {
        "point": lambda: cc.PointLight((3, 2, 3), shadow=shadow),
        "spot": lambda: cc.SpotLight((3, 2, 3), (0, -1, 0), angle=70, shadow=shadow),
    }[kind]()
    got = lit(renderer, stage(sheet(), masked(map=picture()), light)) > 0
    at = (np.arange(WIDE) + 0.5) / WIDE * 3 + 1.5  # on the sheet
    inside = np.abs(at - np.round(at)) > 0.08
    want = ~CELLS[np.ix_(at.astype(int), at.astype(int))]
    np.testing.assert_array_equal(got[np.ix_(inside, inside)], want[np.ix_(inside, inside)])


def test_the_place_of_the_map(any_path):
    """A second set of uvs, turned by a quarter, moved and scaled: uv' = offset + R (scale uv)."""
    texture = cc.Texture(picture(), uv_set=1, rotation=90, offset=(2, 0.5), scale=(2, 2))
    scene = stage(sheet(np.zeros((4, 2)), uvs1=SQUARE), masked(map=texture))
    at = (np.arange(12) + 0.5) / 12
    u, v = np.meshgrid(at, 1 - at)
    placed = (2 - 2 * v) % 1, (0.5 + 2 * u) % 1
    cells = CELLS[((1 - placed[1]) * 6).astype(int), (placed[0] * 6).astype(int)]
    check(any_path, scene, cells)


@pytest.mark.parametrize(
    ("alpha", "solid"), [(1, CELLS), (0.65, np.zeros((6, 6), bool)), (0.75, CELLS)]
)
def test_the_alpha_of_the_colour_counts(renderer, alpha, solid):
    check(renderer, stage(sheet(), masked(map=picture(), color=(1, 1, 1, alpha))), solid)


@pytest.mark.parametrize(
    ("cutoff", "solid"), [(0.2, np.ones((6, 6), bool)), (0.5, CELLS), (0.9, ~np.ones((6, 6), bool))]
)
def test_the_cutoff(renderer, cutoff, solid):
    check(renderer, stage(sheet(), masked(map=picture(), alpha_cutoff=cutoff)), solid)


def test_a_colour_alone_may_be_below_the_cutoff(renderer):
    mesh = cc.Mesh(sheet().positions, sheet().indices)
    check(renderer, stage(mesh, masked(color=(1, 1, 1, 0.4))), np.zeros((6, 6), bool))
    check(renderer, stage(mesh, masked(color=(1, 1, 1, 0.6))), np.ones((6, 6), bool))


@pytest.mark.parametrize("shown", [True, False])
def test_the_alpha_of_vertices(renderer, shown):
    positions: list[Any] = []
    indices: list[Any] = []
    colors: list[Any] = []
    for row in range(6):
        for column in range(6):
            first = len(positions)
            positions += [
                (column, 1, row),
                (column, 1, row + 1),
                (column + 1, 1, row + 1),
                (column + 1, 1, row),
            ]
            indices += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
            colors += [(1, 1, 1, ALPHA[row, column])] * 4
    mesh = cc.Mesh(positions, indices, colors=np.array(colors))
    check(
        renderer,
        stage(mesh, masked(vertex_colors=shown)),
        CELLS if shown else np.ones((6, 6), bool),
    )


def test_a_map_without_uvs_makes_no_holes(renderer):
    mesh = cc.Mesh(sheet().positions, sheet().indices)
    check(renderer, stage(mesh, masked(map=picture())), np.ones((6, 6), bool))


def test_many_sheets_of_one_mesh_each_have_their_holes(renderer):
    """Twenty small sheets: half with one picture, half with the opposite one, and solid ones of the same mesh."""
    scene = cc.Scene()
    scene.add(cc.DirectionalLight((0, -1, 0), shadow=cc.Shadow(size=512)))
    scene.add(cc.Mesh.box((6, 0.1, 6)), cc.PhongMaterial(ka=0, kd=1, ks=0), position=(3, -0.05, 3))
    mesh = sheet()
    materials = masked(map=picture()), masked(map=picture(1 - ALPHA)), cc.PhongMaterial()
    solid = np.zeros((36, 36), bool)
    for i in range(36):
        x, z = i % 6, i // 6
        scene.add(mesh, materials[i % 3], position=(x, 0, z), scale=(1 / 6, 1, 1 / 6))
        solid[6 * z : 6 * z + 6, 6 * x : 6 * x + 6] = (CELLS, ~CELLS, np.ones((6, 6), bool))[i % 3]
    got = lit(renderer, scene)
    at = (np.arange(WIDE) + 0.5) / WIDE * 36
    inside = np.abs(at - np.round(at)) > 0.3
    want = ~solid[np.ix_(at.astype(int), at.astype(int))]
    mask = np.ix_(inside, inside)
    np.testing.assert_array_equal(got[mask] > 0.5, want[mask])


def test_a_render_texture_may_be_the_mask(renderer):
    """Its picture is drawn before the shadow, and the shadow follows it."""
    inner = cc.Scene(background=(1, 1, 1, 1))
    hole = inner.add(
        cc.Mesh.plane(1, 1),
        cc.BasicMaterial(
            opacity=0.2, blend=cc.Blend("src_alpha", "zero", src_alpha="one", dst_alpha="zero")
        ),
        rotation=cc.axis_angle((1, 0, 0), 90),
    )
    view = cc.OrthographicCamera(height=2, position=(0, 0, 2), target=(0, 0, 0))
    texture = cc.RenderTexture(inner, view, size=(64, 64), format="rgba32f")
    scene = stage(sheet(), masked(map=texture))
    for x in (-0.5, 0.5):
        hole.position = (x, 0, 0)
        hole.scale = (0.5, 1, 1)
        got = lit(renderer, scene)
        middle = got[WIDE // 2]
        column = int((x / 2 + 0.5) * WIDE)
        assert middle[column] == pytest.approx(1, abs=0.01)
        assert middle[WIDE - 1 - column] == pytest.approx(0, abs=0.01)
        with cc.Renderer(device=DEVICE) as fresh:
            assert_identical(lit(fresh, scene), got)


def test_pictures_after_changes_equal_pictures_from_scratch(renderer):
    mesh = sheet(uvs1=SQUARE * 2)
    material = masked(map=picture())
    scene = stage(mesh, material)
    before = lit(renderer, scene)
    turned = cc.Texture(picture(), rotation=180, offset=(1, 1))
    changes = [
        lambda: setattr(material, "map", picture(1 - ALPHA)),
        lambda: setattr(material, "map", turned),
        lambda: setattr(material, "alpha_cutoff", 0.2),
        lambda: setattr(material, "alpha_cutoff", 0.8),
        lambda: setattr(material, "alpha_cutoff", 0.5),
        lambda: setattr(material, "map", cc.Texture(picture(), uv_set=1)),
        lambda: setattr(material, "color", (1, 1, 1, 0.5)),
        lambda: setattr(material, "color", (1, 1, 1, 1)),
        lambda: setattr(material, "alpha_mode", "opaque"),
        lambda: setattr(material, "alpha_mode", "mask"),
        lambda: setattr(mesh, "uvs1", SQUARE * 3),
    ]
    for change in changes:
        change()
        got = lit(renderer, scene)
        with cc.Renderer(device=DEVICE) as fresh:
            assert_identical(got, lit(fresh, scene))
        assert not np.array_equal(got, before)
        before = got
        assert_identical(lit(renderer, scene), got)
        assert renderer.stats.shadow_views_drawn == 0


def test_a_change_of_what_holes_do_not_depend_on_draws_no_shadow(renderer):
    material = cc.StandardMaterial(map=picture(np.ones((6, 6))))
    scene = stage(sheet(), material)
    lit(renderer, scene)
    material.roughness = 0.3
    lit(renderer, scene)
    assert renderer.stats.shadow_views_drawn == 0
