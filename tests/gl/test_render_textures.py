"""Render textures: their contents, the materials that show them, and the times when they are drawn."""

import gc
import itertools

import numpy as np
import psutil
import pytest

import cubecam as cc
from cubecam.truth.shading.images import sample_image
from cubecam.typing import Format
from tests.compare import assert_close, assert_identical
from tests.gl.flat import (
    CORNERS,
    flat_camera,
    flat_scene,
    flat_texture,
    look,
    quad,
    random_picture,
    screen_scene,
    tiles,
)
from tests.gl.world import World, inner, perspective, triangles_of
from tests.helpers import DEVICE, need_own_memory, run_python

PICTURE = random_picture(1)
OTHER = random_picture(2)


# The contents of a render texture, and their orientation.


@pytest.mark.parametrize("fmt", ["rgba8", "rgba16f", "rgba32f"])
def test_a_quad_shows_the_picture_texel_by_texel(any_path, fmt):
    texture = flat_texture(PICTURE, format=fmt)
    scene, _ = screen_scene(texture)
    color = look(any_path, scene)
    tolerance = {"rgba8": "unorm8", "rgba16f": "half", "rgba32f": "lookup"}[fmt]
    assert_close(color[..., :3], PICTURE, tolerance)
    assert (color[..., 3] == 1).all()


def test_texture_gives_what_it_holds_row_0_on_top(renderer):
    for fmt, dtype in {"rgba8": "uint8", "rgba16f": "float16", "rgba32f": "float32"}.items():
        texture = flat_texture(PICTURE, format=fmt)
        look(renderer, screen_scene(texture)[0])
        held = renderer.read_texture(texture)
        assert (held.shape, held.dtype) == ((6, 9, 4), dtype)
        if fmt == "rgba8":
            assert_identical(held[..., :3], np.round(PICTURE * 255).astype(np.uint8))
        else:
            assert_close(held[..., :3], PICTURE, "half" if fmt == "rgba16f" else "float32_maths")
        held[:] = 0  # the array belongs to the caller
        assert renderer.read_texture(texture).any()


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("fmt", ["rgba8", "rgba16f", "rgba32f"])
def test_it_holds_what_a_frame_of_its_scene_shows(any_path, fmt, samples):
    inner_scene = cc.Scene(background=(0.2, 0.4, 0.1, 0.5))
    inner_scene.add(cc.PointLight(position=(3, 4, 5)))
    inner_scene.add(cc.Mesh.sphere(1), cc.PhongMaterial(color=(1, 0.3, 0.2)), position=(0.3, 0, 0))
    inner_scene.add(
        cc.Mesh.box(0.7), cc.BasicMaterial(color=(0, 1, 0, 0.5)), position=(-0.6, 0.2, 1)
    )
    camera = cc.PerspectiveCamera(fov=50, position=(0, 1, 4), target=(0, 0, 0))
    texture = cc.RenderTexture(inner_scene, camera, size=(20, 14), format=fmt, samples=samples)
    look(any_path, screen_scene(texture)[0])
    want = any_path.render(inner_scene, camera, (20, 14), format=fmt, samples=samples).color
    assert_identical(any_path.read_texture(texture), want)


def test_perspective_camera_takes_its_aspect_from_the_size(renderer):
    inner_scene = cc.Scene()
    inner_scene.add(cc.Mesh.box((3, 1, 0.1)), cc.BasicMaterial(), position=(0, 0, 0))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 2), target=(0, 0, 0))
    texture = cc.RenderTexture(inner_scene, camera, size=(40, 10))
    look(renderer, screen_scene(texture)[0])
    held = renderer.read_texture(texture)[..., 3] > 0
    # The box is 3 wide; the picture spans 2 tan(30) * 1.95 * 4 = 4.5 at the box's front.
    assert held.any(axis=0).sum() == pytest.approx(
        40 * 3 / (2 * np.tan(np.pi / 6) * 1.95 * 4), abs=1
    )


@pytest.mark.parametrize("wrap", ["repeat", "clamp"])
def test_wrapping_and_bilinear_lookups(renderer, wrap):
    mesh = quad(uvs=CORNERS * 3 - 1.2)
    material = cc.BasicMaterial(map=flat_texture(PICTURE, wrap=wrap))
    world = World()
    world.add(mesh, triangles_of(mesh), material=material, position=(-0.5, -0.5, 0))
    view = perspective((0.2, 0.1, 1.1), (0, 0, 0), size=(40, 40))
    color = renderer.render(world.scene, view.camera, view.size, format="rgba32f").color
    hits = view.hits(world.shapes)
    mask = inner(hits) & hits.hit
    want = sample_image(PICTURE, hits.uv[mask], wrap)
    assert_close(color[mask][..., :3], want, "mirror")


def test_changing_the_wrap_alone_is_seen(renderer, new_renderer):
    texture = flat_texture(PICTURE, wrap="clamp")
    scene = cc.Scene()
    scene.add(quad(9, 6, uvs=CORNERS * 2), cc.BasicMaterial(map=texture))
    first = look(renderer, scene)
    texture.wrap = "repeat"
    second = look(renderer, scene)
    assert (first != second).any()
    assert renderer.stats.views_drawn == 1
    assert_identical(second, look(new_renderer(), scene))
    texture.wrap = "clamp"
    assert_identical(look(renderer, scene), first)


def test_mipmaps_average_far_away(renderer):
    picture = np.random.default_rng(10).integers(0, 2, (64, 64, 3)).astype(float)
    spread = {}
    for mipmaps in (False, True):
        scene = cc.Scene()
        scene.add(quad(8, 8), cc.BasicMaterial(map=flat_texture(picture, mipmaps=mipmaps)))
        spread[mipmaps] = look(renderer, scene, 8, 8)[..., :3].std()
    assert spread[True] < 0.1 < 0.2 < spread[False]


def test_mipmaps_are_those_of_a_box_filter(renderer):
    """Drawn at half the size, a texture is looked up exactly at level 1: the mean of 2 x 2 texels."""
    picture = random_picture(3, 8, 16)
    scene = cc.Scene()
    scene.add(quad(8, 4), cc.BasicMaterial(map=flat_texture(picture, mipmaps=True)))
    want = picture.reshape(4, 2, 8, 2, 3).mean(axis=(1, 3))
    assert_close(look(renderer, scene, 8, 4)[..., :3], want, "mirror")


def test_multisampling_smooths_edges(renderer):
    inner_scene = cc.Scene()
    inner_scene.add(
        cc.Mesh.box(1),
        cc.BasicMaterial(),
        rotation=cc.axis_angle((0, 0, 1), 20),
        position=(4, 3, 0),
    )
    levels = {}
    for samples in (1, 4):
        texture = cc.RenderTexture(
            inner_scene, flat_camera(8, 6), size=(32, 24), format="rgba32f", samples=samples
        )
        look(renderer, screen_scene(texture)[0], 32, 24)
        levels[samples] = set(np.unique(renderer.read_texture(texture)[..., 0]))
    assert levels[1] == {0, 1}
    assert levels[4] == {0, 0.25, 0.5, 0.75, 1} & levels[4]
    assert len(levels[4]) > 2


def test_light_above_one_is_kept_in_half_floats_and_clipped_in_bytes(renderer):
    inner_scene = cc.Scene(background=(4, 0.5, 1000))
    wanted: dict[Format, tuple[float, ...]] = {
        "rgba8": (1, 0.5, 1),
        "rgba16f": (4, 0.5, 1000),
    }
    for fmt, want in wanted.items():
        texture = cc.RenderTexture(inner_scene, flat_camera(4, 4), size=(4, 4), format=fmt)
        color = look(renderer, screen_scene(texture)[0], 4, 4)
        np.testing.assert_allclose(color[..., :3], np.broadcast_to(want, (4, 4, 3)), atol=2e-3)


def test_alpha_counts_only_where_the_material_is_translucent(renderer):
    """The picture's lower half is background (0, 0, 0, 0)."""
    picture = np.ones((2, 4, 3))
    inner_scene = cc.Scene()
    inner_scene.add(
        tiles(picture), cc.BasicMaterial(color=(1, 0, 0), vertex_colors=True), position=(0, 2, 0)
    )
    texture = cc.RenderTexture(inner_scene, flat_camera(4, 4), size=(4, 4), format="rgba32f")
    scene, node = screen_scene(texture)
    scene.background = (0, 0, 1)
    color = look(renderer, scene, 4, 4)
    assert (color[:2] == [1, 0, 0, 1]).all()
    assert (color[2:] == [0, 0, 0, 1]).all()
    node.material.opacity = 0.5
    color = look(renderer, scene, 4, 4)
    np.testing.assert_allclose(color[:2], np.broadcast_to([0.5, 0, 0.5, 1], (2, 4, 4)), atol=1e-6)
    assert (color[2:] == [0, 0, 1, 1]).all()


def test_it_multiplies_colors_and_phong_takes_it_too(renderer):
    texture = flat_texture(PICTURE)
    scene, node = screen_scene(texture)
    node.material.color = (0.5, 2, 0.25)
    assert_close(look(renderer, scene)[..., :3], PICTURE * [0.5, 2, 0.25], "lookup")
    node.material = cc.PhongMaterial(map=texture, ka=0.6)
    assert_close(look(renderer, scene)[..., :3], PICTURE * 0.6, "lookup")
    node.material.map = None
    assert_close(look(renderer, scene)[..., :3], np.full((6, 9, 3), 0.6), "lookup")


# Every frame shows this frame's picture, never that of the frame before.


def test_every_frame_shows_this_frames_picture(any_path):
    """P10: one texel is lit, and in each frame it is the next one."""
    inner_scene = cc.Scene(background=(0, 0, 0, 1))
    dot = inner_scene.add(quad(), cc.BasicMaterial(color=(1, 0.5, 0.25)), position=(0, 5, 0))
    texture = cc.RenderTexture(inner_scene, flat_camera(9, 6), size=(9, 6), format="rgba32f")
    scene, _ = screen_scene(texture)
    for column in range(9):
        dot.position = (column, 5, 0)
        color = look(any_path, scene)
        want = np.zeros((6, 9, 3))
        want[0, column] = (1, 0.5, 0.25)
        assert_close(color[..., :3], want, "lookup", name=f"frame {column}")
        assert any_path.stats.textures_updated == 1


def test_a_moving_camera_of_the_texture_is_a_change(renderer):
    texture = flat_texture(PICTURE)
    scene, _ = screen_scene(texture)
    look(renderer, scene)
    texture.camera.position = (4.5, 4, 5)
    texture.camera.target = (4.5, 4, 0)
    want = np.zeros((6, 9, 3))
    want[1:] = PICTURE[:-1]
    assert_close(look(renderer, scene)[..., :3], want, "lookup")


def test_unchanged_scenes_draw_nothing(any_path):
    texture = flat_texture(PICTURE)
    scene, _ = screen_scene(texture)
    first = look(any_path, scene)
    assert (any_path.stats.views_drawn, any_path.stats.textures_updated) == (2, 1)
    second = look(any_path, scene)
    stats = any_path.stats
    assert (stats.views_drawn, stats.views_skipped, stats.textures_updated) == (0, 2, 0)
    assert stats.draw_calls == 0
    assert_identical(first, second)


def test_setting_equal_values_changes_nothing(renderer):
    texture = flat_texture(PICTURE, name="a")
    scene, node = screen_scene(texture)
    look(renderer, scene)
    for name in (
        "scene",
        "camera",
        "size",
        "format",
        "samples",
        "mipmaps",
        "wrap",
        "exclude",
        "name",
    ):
        setattr(texture, name, getattr(texture, name))
    node.material.map = texture
    texture.name = "b"
    look(renderer, scene)
    assert renderer.stats.views_drawn == 0


def test_only_the_pixels_that_show_it_are_drawn_again(renderer):
    texture = flat_texture(PICTURE)
    scene, _ = screen_scene(texture)
    far = scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=(1, 0, 0)), position=(30, 3, 0))
    look(renderer, scene, 40, 6)
    texture.scene.background = (0, 1, 0)
    look(renderer, scene, 40, 6)
    assert renderer.stats.draw_calls == 2  # one for the tiles, one for the screen
    assert far.visible


def test_what_is_not_in_view_is_not_drawn(renderer):
    texture = flat_texture(PICTURE)
    scene, node = screen_scene(texture)
    node.position = (100, 0, 0)
    look(renderer, scene)
    assert renderer.stats.textures_updated == 0
    with pytest.raises(ValueError, match="drawn"):
        renderer.read_texture(texture)
    node.position, node.visible = (0, 0, 0), False
    look(renderer, scene)
    assert renderer.stats.textures_updated == 0
    node.visible = True
    look(renderer, scene)
    assert renderer.stats.textures_updated == 1


def test_a_mesh_without_uvs_shows_no_texture(renderer):
    texture = flat_texture(PICTURE)
    scene = cc.Scene()
    scene.add(cc.Mesh(quad(9, 6).positions, [[0, 1, 2], [0, 2, 3]]), cc.BasicMaterial(map=texture))
    assert (look(renderer, scene)[..., :3] == 1).all()
    assert renderer.stats.textures_updated == 0


def test_exclude_covers_subtrees_and_forgets_the_dead(renderer):
    texture = flat_texture(PICTURE)
    inner_scene = texture.scene
    cover = inner_scene.add(position=(0, 0, 1))
    inner_scene.add(quad(9, 3), cc.BasicMaterial(color=(1, 0, 0)), parent=cover)
    other = inner_scene.add(quad(9, 1), cc.BasicMaterial(color=(0, 1, 0)), position=(0, 5, 1))
    scene, _ = screen_scene(texture)
    texture.exclude = [cover, scene.nodes[0]]  # the second node belongs to another scene
    want = PICTURE.copy()
    want[0] = (0, 1, 0)
    assert_close(look(renderer, scene)[..., :3], want, "lookup")
    texture.exclude = [other]
    inner_scene.remove(other)
    del other
    gc.collect()
    assert texture.exclude == ()
    want = PICTURE.copy()
    want[3:] = (1, 0, 0)
    assert_close(look(renderer, scene)[..., :3], want, "lookup")


# Textures in textures.


def chain(count, **options):
    """Textures that show each other's picture: the last one's scene is the picture itself."""
    textures = [flat_texture(PICTURE, name=f"t{count - 1}", **options)]
    for index in reversed(range(count - 1)):
        scene, _ = screen_scene(textures[0])
        textures.insert(
            0,
            cc.RenderTexture(
                scene, flat_camera(9, 6), size=(9, 6), format="rgba32f", name=f"t{index}", **options
            ),
        )
    return textures


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_nested_textures_are_drawn_inside_out_whatever_the_order_of_add(new_renderer, order):
    """Three screens side by side: the picture, a texture of it, and a texture of that."""
    renderer = new_renderer()
    textures = chain(3)
    scene = cc.Scene()
    for index in order:
        scene.add(quad(9, 6), cc.BasicMaterial(map=textures[index]), position=(9 * index, 0, 0))
    for seed in range(3):
        picture = random_picture(seed)
        textures[-1].scene.nodes[0].mesh = tiles(picture)
        color = look(renderer, scene, 27, 6)
        assert_close(color[..., :3], np.concatenate([picture] * 3, axis=1), "lookup")
        assert renderer.stats.textures_updated == 3
        assert renderer.stats.views_drawn == 4
    look(renderer, scene, 27, 6)
    assert renderer.stats.views_drawn == 0


def test_a_texture_needed_twice_is_drawn_once(renderer):
    """Two other textures and the frame need one texture."""
    picture = flat_texture(PICTURE)
    left, right = (
        cc.RenderTexture(screen_scene(picture)[0], flat_camera(9, 6), size=(9, 6), format="rgba32f")
        for _ in range(2)
    )
    scene = cc.Scene()
    for x, texture in enumerate((left, picture, right)):
        scene.add(quad(9, 6), cc.BasicMaterial(map=texture), position=(9 * x, 0, 0))
    color = look(renderer, scene, 27, 6)
    assert renderer.stats.textures_updated == 3
    assert_close(color[..., :3], np.concatenate([PICTURE] * 3, axis=1), "lookup")


@pytest.mark.slow
def test_deep_chains_neither_overflow_nor_hang():
    """A chain of 1000 textures is drawn and freed; a chain of 30000 is freed without being drawn."""
    run_python(
        """
        import numpy as np, cubecam as cc
        camera = cc.OrthographicCamera(height=1, position=(0, 0, 5))
        mesh = cc.Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]], uvs=[[0, 0]] * 4)
        def chain(count):
            scene = cc.Scene(background=(1, .5, .25))
            for _ in range(count):
                texture = cc.RenderTexture(scene, camera, size=(1, 1), format="rgba32f")
                scene = cc.Scene()
                scene.add(mesh, cc.BasicMaterial(map=texture))
            return scene
        scene = chain(1000)
        with cc.Renderer() as renderer:
            color = renderer.render(scene, camera, (1, 1), format="rgba32f").color
            assert renderer.stats.textures_updated == 1000
        assert color.ravel().tolist() == [1, .5, .25, 1]
        scene = chain(30000)
        del scene
        """,
        timeout=300,
    )


# Render textures in captures, probes and mirrors.


def wall(texture):
    """A screen that fills what the -Z face of a capture at the origin sees."""
    scene = cc.Scene()
    node = scene.add(quad(2, 2), cc.BasicMaterial(map=texture), position=(-1, -1, -1))
    return scene, node


SQUARE = random_picture(5, 8, 8)


def test_captures_show_textures(any_path):
    texture = flat_texture(SQUARE)
    scene, _ = wall(texture)
    cube = any_path.capture(scene, size=8)
    assert any_path.stats.textures_updated == 1
    # Someone who stands inside sees the picture unmirrored.
    assert_close(cube.to_convention("inside")[5][..., :3], SQUARE, "lookup")
    texture.scene.nodes[0].mesh = tiles(SQUARE[::-1])
    cube = any_path.capture(scene, size=8)
    assert any_path.stats.textures_updated == 1
    assert_close(cube.to_convention("inside")[5][..., :3], SQUARE[::-1], "lookup")


def test_probes_and_mirrors_show_this_frames_texture(any_path):
    texture = flat_texture(SQUARE)
    scene, _ = wall(texture)
    ball = scene.add(cc.Mesh.sphere(0.3), cc.MirrorMaterial())
    ball.environment = cc.Probe(size=8, format="rgba32f")
    camera = cc.PerspectiveCamera(fov=40, position=(0, 0, -0.9), target=(0, 0, 0))
    seen = []
    for picture in (SQUARE, SQUARE[::-1], SQUARE[:, ::-1]):
        texture.scene.nodes[0].mesh = tiles(picture)
        seen.append(any_path.render(scene, camera, (24, 24), format="rgba32f").color)
        held = any_path.read_probe(ball.environment)
        assert_close(held.to_convention("inside")[5][..., :3], picture, "lookup")
    assert (seen[0] != seen[1]).any()
    assert (seen[1] != seen[2]).any()
    # The mirror is seen from the wall, so its middle shows the middle of the wall.
    assert seen[2][12, 12, :3] == pytest.approx(
        sample_image(SQUARE[:, ::-1], np.array([[0.5, 0.5]]))[0], abs=0.35
    )


def test_a_textures_scene_may_hold_mirrors_with_probes(any_path, new_renderer):
    inner_scene = cc.Scene(background=(0.1, 0.2, 0.3))
    box = inner_scene.add(
        cc.Mesh.box(0.5), cc.BasicMaterial(color=(1, 0, 0)), position=(1.2, 0, 0.8)
    )
    ball = inner_scene.add(cc.Mesh.sphere(0.6), cc.MirrorMaterial())
    ball.environment = cc.Probe(size=16, format="rgba32f")
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0.5, 3), target=(0, 0, 0))
    texture = cc.RenderTexture(inner_scene, camera, size=(16, 12), format="rgba32f")
    scene, _ = screen_scene(texture)
    for x in (1.2, 0.4, -1.0):
        box.position = (x, 0.2, 0.9)
        color = look(any_path, scene, 16, 12)
        stats = any_path.stats
        assert (stats.textures_updated, stats.probes_updated) == (1, 1)
        want = new_renderer().render(inner_scene, camera, (16, 12), format="rgba32f").color
        assert_identical(any_path.read_texture(texture), want)
        assert_close(color, want, "lookup")


# Textures and probes shared by scenes and renderers.


def test_two_scenes_show_one_texture(renderer):
    texture = flat_texture(PICTURE)
    one, two = screen_scene(texture)[0], screen_scene(texture)[0]
    two.nodes[0].material.color = (1, 0, 0)
    assert_close(look(renderer, one)[..., :3], PICTURE, "lookup")
    assert renderer.stats.views_drawn == 2
    assert_close(look(renderer, two)[..., :3], PICTURE * [1, 0, 0], "lookup")
    assert (renderer.stats.views_drawn, renderer.stats.textures_updated) == (1, 0)
    texture.scene.nodes[0].mesh = tiles(OTHER)
    assert_close(look(renderer, two)[..., :3], OTHER * [1, 0, 0], "lookup")
    assert_close(look(renderer, one)[..., :3], OTHER, "lookup")


def test_contents_live_in_the_renderer(new_renderer):
    texture = flat_texture(PICTURE)
    scene, _ = screen_scene(texture)
    a, b = new_renderer(), new_renderer()
    look(a, scene)
    held = a.read_texture(texture)
    texture.scene.nodes[0].mesh = tiles(OTHER)
    look(b, scene)
    assert_identical(a.read_texture(texture), held)
    assert (b.read_texture(texture) != held).any()
    a.close()
    with pytest.raises(cc.ContextError, match="closed"):
        a.read_texture(texture)
    assert_close(b.read_texture(texture)[..., :3], OTHER, "float32_maths")
    assert_close(look(b, scene)[..., :3], OTHER, "lookup")


def test_a_texture_that_was_never_drawn_is_refused(renderer):
    with pytest.raises(
        ValueError, match="render_texture: expected one that this renderer has drawn"
    ):
        renderer.read_texture(flat_texture(PICTURE))


@pytest.mark.parametrize("wrong", [None, "screen", cc.Probe])
def test_what_is_no_render_texture(renderer, wrong):
    with pytest.raises(TypeError):
        renderer.read_texture(wrong() if wrong is cc.Probe else wrong)


def test_one_probe_in_two_scenes_of_a_call_is_true_to_each(renderer, new_renderer):
    """The mirror of the frame's scene and that of the texture's share a Probe; each sees its own surroundings."""
    probe = cc.Probe(size=8, format="rgba32f")

    def hall(color):
        scene = cc.Scene(background=color)
        scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), environment=probe)
        return scene

    camera = cc.PerspectiveCamera(fov=30, position=(0, 0, 4), target=(0, 0, 0))
    texture = cc.RenderTexture(hall((0, 1, 0)), camera, size=(8, 8), format="rgba32f")
    scene = hall((1, 0, 0))
    scene.add(quad(1, 1), cc.BasicMaterial(map=texture), position=(0.6, 0, 0))
    for _ in range(2):
        color = renderer.render(scene, camera, (24, 24), format="rgba32f").color
        assert (renderer.read_texture(texture)[..., :3] == [0, 1, 0]).all()
        assert (color[12, 8, :3] == [1, 0, 0]).all()
    assert renderer.stats.views_drawn == 0
    assert_identical(new_renderer().render(scene, camera, (24, 24), format="rgba32f").color, color)


# A monitor may stand in the room that it shows.


def monitor_room():
    """A room, and a monitor in it that shows the room without the monitor."""
    scene = cc.Scene(background=(0.1, 0.1, 0.3))
    box = scene.add(cc.Mesh.box(0.6), cc.BasicMaterial(color=(1, 0.2, 0)), position=(-0.8, 0, 0))
    texture = cc.RenderTexture(
        scene,
        cc.PerspectiveCamera(fov=60, position=(0.5, 1, 3), target=(0, 0, 0)),
        size=(16, 12),
        format="rgba32f",
        name="monitor",
    )
    screen = scene.add(quad(1.6, 1.2), cc.BasicMaterial(map=texture), position=(0, -0.3, 0.2))
    texture.exclude = [screen]
    return scene, box, texture, screen


def test_a_monitor_shows_its_room(any_path, new_renderer):
    scene, box, texture, screen = monitor_room()
    camera = cc.PerspectiveCamera(fov=50, position=(0.3, 0.4, 4), target=(0, 0, 0))
    for x in (-0.8, -0.6, -0.4):
        box.position = (x, 0.1, 0)
        color = any_path.render(scene, camera, (24, 18), format="rgba32f").color
        screen.visible = False
        want = new_renderer().render(scene, texture.camera, (16, 12), format="rgba32f").color
        screen.visible = True
        assert_identical(any_path.read_texture(texture), want)
        assert_identical(
            color, new_renderer().render(scene, camera, (24, 18), format="rgba32f").color
        )
    any_path.render(scene, camera, (24, 18), format="rgba32f")
    assert any_path.stats.views_drawn == 0


def test_probes_are_counted_once_a_call_however_often_their_scene_is_drawn(renderer):
    """A mirror whose probe is drawn on every second call, in a room that a monitor shows as well."""
    scene, box, _, screen = monitor_room()
    ball = scene.add(cc.Mesh.sphere(0.4), cc.MirrorMaterial(), position=(0.8, 0.8, 0))
    ball.environment = cc.Probe(
        position=(0.8, 0.8, 0), size=8, format="rgba32f", update=2, exclude=[screen]
    )
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0.4, 4), target=(0, 0, 0))
    changed = []
    for step in range(6):
        box.material.color = (step / 8, 0, 0)
        renderer.render(scene, camera, (24, 18))
        changed.append(renderer.stats.probes_updated)
    assert changed == [1, 0, 1, 0, 1, 0]
    ball.environment.update = "once"
    renderer.render(scene, camera, (24, 18))
    assert renderer.stats.probes_updated == 0
    box.material.color = (0, 1, 1)
    renderer.update_probes(scene, probes=ball.environment)
    assert renderer.stats.probes_updated == 1


def test_tonemapping_is_the_frames_alone(renderer):
    inner_scene = cc.Scene(background=(3, 3, 3))
    texture = cc.RenderTexture(inner_scene, flat_camera(4, 4), size=(4, 4), format="rgba32f")
    scene, _ = screen_scene(texture)
    color = look(renderer, scene, 4, 4, tonemap="reinhard")
    np.testing.assert_allclose(color[..., :3], 0.75, atol=1e-4)
    assert (renderer.read_texture(texture)[..., :3] == 3).all()


# Each property is edited alone, on a renderer that has drawn the scene before.

EDITS = {
    "scene": lambda t: setattr(t, "scene", flat_scene(OTHER)[0]),
    "camera": lambda t: setattr(t, "camera", flat_camera(7, 5)),
    "size": lambda t: setattr(t, "size", (5, 12)),
    "format": lambda t: setattr(t, "format", "rgba8"),
    "samples": lambda t: setattr(t, "samples", 4),
    "mipmaps": lambda t: setattr(t, "mipmaps", True),
    "wrap": lambda t: setattr(t, "wrap", "repeat"),
    "exclude": lambda t: setattr(t, "exclude", t.scene.nodes[:1]),
    "node": lambda t: setattr(t.scene.nodes[0], "position", (1, 1, 0)),
    "lens": lambda t: setattr(t.camera, "height", 7.5),
}


@pytest.mark.parametrize("edit", EDITS.values(), ids=EDITS)
def test_each_edit_equals_a_drawing_from_scratch(new_renderer, edit):
    texture = flat_texture(PICTURE)
    scene = cc.Scene()
    scene.add(quad(9, 6, uvs=CORNERS * 3 - 0.7), cc.BasicMaterial(map=texture))
    live = new_renderer()
    before = look(live, scene)
    edit(texture)
    after = look(live, scene)
    assert (after != before).any() or edit is EDITS["samples"]
    scratch = new_renderer()
    assert_identical(after, look(scratch, scene))
    assert_identical(live.read_texture(texture), scratch.read_texture(texture))


# Memory and limits.


def test_contents_go_with_their_texture(new_renderer):
    """A stream of textures of 512 x 512 floats, 5 MB each, does not fill the memory."""
    need_own_memory()
    renderer = new_renderer()
    me = psutil.Process()

    def one(index):
        inner_scene = cc.Scene(background=(index, 0, 0))
        texture = cc.RenderTexture(
            inner_scene, flat_camera(4, 4), size=(512, 512), format="rgba32f"
        )
        look(renderer, screen_scene(texture)[0], 4, 4)

    for index in range(8):
        one(index)
    before = me.memory_info().rss / 2**20
    for index in range(50):
        one(index)
    grown = me.memory_info().rss / 2**20 - before
    assert grown < 60, f"{grown:.0f} MB more after fifty textures"


def test_limits_are_named_with_the_texture(renderer):
    limit = renderer.info.limits.max_texture_size
    scene, _ = screen_scene(flat_texture(PICTURE, size=(limit + 1, 2), name="screen"), (9, 6))
    with pytest.raises(
        ValueError, match=f'RenderTexture "screen": size: expected 1 to {limit} pixels'
    ):
        look(renderer, scene)
    scene, _ = screen_scene(flat_texture(PICTURE, size=(2**40, 2)), (9, 6))
    with pytest.raises(ValueError, match=str(limit)):
        look(renderer, scene)
    texture = flat_texture(PICTURE, samples=renderer.info.limits.max_samples + 1)
    scene, _ = screen_scene(texture)
    with pytest.raises(ValueError, match="samples: expected"):
        look(renderer, scene)
    texture.samples = 1
    assert_close(look(renderer, scene)[..., :3], PICTURE, "lookup")


def test_layered_equals_one_pass(shared_renderers):
    texture = flat_texture(SQUARE, mipmaps=True, samples=4)
    scene, _ = wall(texture)
    ball = scene.add(cc.Mesh.sphere(0.3), cc.MirrorMaterial(), position=(0.1, 0, 0))
    ball.environment = cc.Probe(size=12, format="rgba32f")
    got = []
    for layered in (None, False):
        with cc.Renderer(device=DEVICE, layered=layered) as renderer:
            cube = renderer.capture(scene, size=12)
            got.append((cube.faces, renderer.read_texture(texture)))
    for a, b in zip(*got, strict=True):
        assert_identical(a, b)
