"""P10: the cube wears this frame's discs, painted in the order they were added, and never the last frame's."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import render_to_texture as example
from cubecam.truth import shading
from tests.compare import assert_close
from tests.programs.oracle import LAMP, Look, moved, turned
from tests.reference.compositing import composite
from tests.reference.raycast import Box, interior

SIZE = (64, 64)


def discs_at(points, frame):
    """The document's flat picture in numbers: translucent discs over white, in order, at (..., 2) points of -1..1.

    The second result is the distance to the nearest rim.
    """
    color = np.broadcast_to([1.0, 1, 1, 1], (*points.shape[:-1], 4))
    rim = np.full(points.shape[:-1], np.inf)
    for paint, radius, rounds in example.DISCS:
        angle = rounds * 2 * np.pi * frame / example.FRAMES
        center = (0.95 - radius) * np.array([np.cos(angle), np.sin(angle)])
        distance = np.linalg.norm(points - center, axis=-1)
        layer = np.zeros((*points.shape[:-1], 4))
        layer[..., :3], layer[..., 3] = paint, np.where(distance < radius, 0.6, 0)
        color = composite(color, layer)
        rim = np.minimum(rim, np.abs(distance - radius))
    return color, rim


@pytest.mark.parametrize("frame", [0, 20, 77])
def test_the_texture_is_painted_in_order(any_path, frame):
    program = example.build(document=True)
    example.draw(program, any_path, frame, SIZE)
    got = any_path.read_texture(program.texture)
    assert got.shape == (512, 512, 4)
    centers = (np.arange(512) + 0.5) / 256 - 1
    points = np.stack(np.meshgrid(centers, -centers), axis=-1)
    want, rim = discs_at(points, frame)
    # The discs have corners: a polygon's edge lies inside its circle.
    assert_close(got / 255, want, "unorm8_steps", mask=rim > 0.01)


def face_uv(local, part):
    """Where a point of the box lies in its texture: (0, 0) is a side's bottom-left seen from outside, up +Y."""
    x, y, z = np.moveaxis(local / 0.8, -1, 0)
    # part is 2 * axis + (outward normal negative)
    u = np.select([part == 0, part == 1, part == 4, part == 5], [-z, z, x, -x])
    return np.stack([u, y], axis=-1)


@pytest.mark.parametrize("frame", [0, 1, 20, 21, 77])
def test_the_cube_shows_this_frames_picture(any_path, frame):
    """One renderer draws several frames, each compared with its own discs; the frame before looks different."""
    program = example.build(document=True)
    for k in (frame + 5, frame):  # what was drawn before does not matter
        got = example.draw(program, any_path, k, SIZE, format="rgba32f")
    look = Look((0, 1.5, 4), (0, 0, 0), 45, 0.1, 1000, SIZE)
    matrix = turned((0.3, 1, 0.2), 3 * frame) @ moved(0, 0, 0)
    hits = look.hits([Box(program.cube.id, matrix, size=1.6)])
    sides = hits.hit & np.isin(hits.part, (0, 1, 4, 5))
    assert sides.sum() > 200
    tints, rims = {}, {}
    for k in (frame, frame - 1):
        tints[k], rims[k] = discs_at(face_uv(np.nan_to_num(hits.local), hits.part), k)
    mask = interior(hits.part, hits.id) & sides & (rims[frame] > 0.05)
    assert mask.sum() > 100
    eye = np.array([0, 1.5, 4])
    white = shading.phong(
        np.nan_to_num(hits.position),
        hits.normal + (~hits.hit)[..., None],
        eye,
        (1, 1, 1),
        [LAMP],
        ka=0.4,
        ks=0,
    )
    gloss = shading.phong(
        np.nan_to_num(hits.position),
        hits.normal + (~hits.hit)[..., None],
        eye,
        (0, 0, 0),
        [LAMP],
        ka=0.4,
    )
    want = {k: white * tints[k][..., :3] + gloss for k in tints}
    assert_close(got[..., :3], want[frame], "texture8", mask=mask, least=0.02)
    changed = mask & (np.abs(want[frame] - want[frame - 1]).max(-1) > 0.1)
    if changed.sum() > 3:
        assert np.abs(got[changed][:, :3] - want[frame - 1][changed]).max() > 0.1


def test_an_unchanged_picture_is_not_drawn_again(fresh_renderer):
    program = example.build(document=True)
    example.draw(program, fresh_renderer, 3, SIZE)
    example.draw(program, fresh_renderer, 3, SIZE)
    assert fresh_renderer.stats.textures_updated == 0
    assert fresh_renderer.stats.views_drawn == 0
    example.draw(program, fresh_renderer, 4, SIZE)
    assert fresh_renderer.stats.textures_updated == 1


def test_a_picture_of_itself_is_refused_by_name(renderer):
    program = example.build(document=True)
    program.texture.scene = program.scene
    with pytest.raises(ValueError, match='RenderTexture "discs" shows itself'):
        example.draw(program, renderer, 0, SIZE)
    program.texture.exclude = [program.cube]
    assert example.draw(program, renderer, 0, SIZE).shape == (64, 64, 4)
    assert isinstance(program.texture, cc.RenderTexture)


@pytest.mark.parametrize("frame", [0, 20, 21])
def test_the_flat_picture_beside_the_cube_is_the_texture(any_path, frame):
    """Staged: the flat picture shows the discs of the frame, as the cube does."""
    program = example.build()
    size = (192, 128)
    got = example.draw(program, any_path, frame, size, format="rgba32f")[..., :3]
    drawn = any_path.render(program.scene, program.camera, size, outputs=("position", "id"))
    flat = next(
        node for node in program.scene.nodes if node.mesh is not None and node.id != program.cube.id
    )
    here = drawn.id == flat.id
    assert here.mean() > 0.1
    assert (drawn.id == program.cube.id).mean() > 0.15
    places = (drawn.position[here] - np.asarray(flat.position))[:, :2] / 0.9
    want, rim = discs_at(places, frame)
    clear = (rim > 0.06) & (np.abs(places).max(-1) < 0.97)
    assert clear.mean() > 0.5
    assert_close(got[here], want[:, :3], "texture8", mask=clear)
    before = discs_at(places, frame - 1)[0]
    assert np.abs(before - want)[clear].max() > 0.1, "the last frame has other discs"


def test_no_side_of_the_cube_is_burnt_out(renderer):
    """The discs keep their colours on each side: nothing but highlights on white is clipped."""
    program = example.build()
    picture = example.draw(program, renderer, example.STILL, (192, 128), format="rgba32f")
    ids = renderer.render(program.scene, program.camera, (192, 128), outputs=("id",)).id
    assert (picture[ids == program.cube.id, :3] > 1.02).any(-1).mean() < 0.05


def test_live_turns_the_cube(renderer):
    with example.live(renderer) as view:
        view.size, view.samples = (48, 32), 1
        still = view.draw()
        assert view._animation is not None
        view._animation(1.0)
        turned = view.draw()
    assert (still != turned).any(-1).mean() > 0.1
    program = example.build()
    np.testing.assert_array_equal(turned, example.draw(program, renderer, 25, (48, 32)))
