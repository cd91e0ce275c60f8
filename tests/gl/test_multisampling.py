"""MSAA: edges are averages, the other outputs are those of one sample, too many samples are refused."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import OUTPUTS, perspective, room
from tests.reference.raycast import interior


def half_plane():
    """A scene that is white on one side of a slanted edge, which crosses the -Z face."""
    scene = cc.Scene()
    scene.add(
        cc.Mesh.box((4, 4, 0.1)),
        cc.BasicMaterial(),
        position=(-2, 0.2, -2),
        rotation=cc.axis_angle((0, 0, 1), 10),
    )
    return scene


@pytest.mark.parametrize("samples", [2, 4])
def test_edges_are_averages(any_path, samples):
    one = any_path.capture(half_plane(), size=32).faces[5, ..., 0]
    many = any_path.capture(half_plane(), size=32, samples=samples).faces[5, ..., 0]
    assert set(np.unique(one)) == {0, 1}
    # GL may give more samples than requested: llvmpipe has 4 or none.
    levels = set(np.unique(many * 4))
    assert levels <= set(range(5))
    assert len(levels) > 2
    assert many.mean() == pytest.approx(one.mean(), abs=0.02)
    assert ((many > 0) & (many < 1)).sum() < 100  # only along the edge


def test_inside_nothing_changes(renderer):
    """Flat colours and the sky, away from edges, are the same bits."""
    scene = room().scene
    scene.background = (0.25, 0.5, 0.125, 1)
    one = renderer.capture(scene, size=32, outputs=("id",))
    four = renderer.capture(scene, size=32, samples=4)
    inside = interior(one.id)
    assert inside.mean() > 0.5
    assert_identical(four.faces[inside], one.faces[inside])


@pytest.mark.parametrize("samples", [2, 4])
def test_other_outputs_equal_those_of_one_sample(any_path, samples):
    scene = room().scene
    one = any_path.capture(scene, size=24, outputs=OUTPUTS)
    many = any_path.capture(scene, size=24, outputs=OUTPUTS, samples=samples)
    for name in OUTPUTS:
        assert_identical(getattr(many, name), getattr(one, name), name)
    view = perspective((1, 0.5, 2), (0, 0, 0))
    one = any_path.render(scene, view.camera, view.size, outputs=OUTPUTS)
    many = any_path.render(scene, view.camera, view.size, outputs=OUTPUTS, samples=samples)
    for name in OUTPUTS:
        assert_identical(getattr(many, name), getattr(one, name), name)
    assert (many.color != one.color).any()


def test_resolved_in_linear_before_tone_mapping(renderer):
    """An edge next to a value of 100 shows the tone-mapped average, not the average of tone-mapped values."""
    scene = half_plane()
    scene.nodes[0].material = cc.BasicMaterial(color=(100, 100, 100))
    camera = cc.PerspectiveCamera(fov=90, position=(0, 0, 0), target=(0, 0, -1))
    raw = renderer.render(scene, camera, (32, 32), format="rgba32f", samples=4).color[..., :3]
    toned = renderer.render(
        scene, camera, (32, 32), format="rgba32f", samples=4, tonemap="reinhard"
    ).color[..., :3]
    mixed = (raw > 0) & (raw < 100)
    assert mixed.any()
    np.testing.assert_allclose(toned[mixed], raw[mixed] / (1 + raw[mixed]), rtol=1e-4)


def test_translucent_edges_blend_per_sample(renderer):
    scene = half_plane()
    scene.nodes[0].material = cc.BasicMaterial(opacity=0.5)
    many = renderer.capture(scene, size=32, samples=4).faces[5, ..., 0]
    assert set(np.unique(many * 16)) <= {0, 2, 4, 6, 8}
    assert len(np.unique(many)) > 2


def test_a_probe_may_be_multisampled(renderer):
    scene = half_plane()
    ball = scene.add(cc.Mesh.sphere(0.1), cc.MirrorMaterial())
    ball.environment = cc.Probe(position=(0, 0, 0), size=32, samples=4, format="rgba32f")
    renderer.update_probes(scene)
    got = renderer.read_probe(ball.environment).faces
    assert_identical(got, renderer.capture(scene, size=32, samples=4, exclude=[ball]).faces)


@pytest.mark.parametrize("samples", [8, 64, 10**9])
def test_more_than_the_limit_is_refused_naming_it(renderer, samples):
    limit = renderer.info.limits.max_samples
    if limit >= samples:
        samples = limit + 1
    scene = cc.Scene()
    with pytest.raises(ValueError, match=rf"{limit}"):
        renderer.capture(scene, size=8, samples=samples)
    with pytest.raises(ValueError, match=rf"{limit}"):
        renderer.render(
            scene,
            cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0)),
            (8, 8),
            samples=samples,
        )


@pytest.mark.parametrize(
    ("samples", "error"), [(0, ValueError), (-1, ValueError), (1.5, TypeError), ("4", TypeError)]
)
def test_bad_sample_counts(renderer, samples, error):
    with pytest.raises(error):
        renderer.capture(cc.Scene(), size=8, samples=samples)
