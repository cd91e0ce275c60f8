"""P7: numpy composites the layers from far to near; alpha stays 1, or has the holes of the plain pair of factors."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import translucent_objects as example
from cubecam.truth import shading
from tests.compare import assert_close
from tests.programs.oracle import LAMP, Look, box, lit, mesh, moved, quad, ry
from tests.reference.compositing import composite
from tests.reference.raycast import interior

SIZE = (56, 56)


def order_of(layers, eye):
    """The layers from far to near, by the distance of their centres."""
    return sorted(layers, key=lambda layer: -np.linalg.norm(layer[0].matrix[:3, 3] - eye))


@pytest.mark.slow
@pytest.mark.parametrize("frame", [6, 30, 78, 102])
def test_layers(renderer, frame):
    program = example.build(document=True)
    color = example.draw(program, renderer, frame, size=SIZE, format="rgba32f")
    look = Look((0, 1.5, 5), (0, 0, 0), 45, 1, 100, SIZE)
    ground, body = program.opaque
    hits = look.hits([quad(ground, 4, moved(0, -0.75, 0)), mesh(body, np.eye(4), ("bunny", 1.5))])
    eye = look.eye
    base = lit(hits, {ground.id: (0.8, 0.8, 0.8)}, eye, (1, 1, 1), ks=0)
    rows = hits.id == body.id
    base[rows] = shading.phong(
        hits.position[rows], hits.normal[rows], eye, (0.8, 0.6, 0.5), [LAMP], ks=0.3
    )
    labels, layers = [hits.id], []
    for index, node in enumerate(program.translucent):
        # Each node moves counter-clockwise round +Y, 3 degrees a frame, and faces outwards.
        degrees = 72 * index
        matrix = ry(3 * frame) @ ry(degrees) @ moved(1.5, 0, 0) @ ry(90)
        pane = index % 2 == 0
        shape = box(node, (1.1, 1.3, 0.04), matrix) if pane else mesh(node, matrix)
        seen = look.hits([shape])
        paint, opacity = (example.PANES if pane else example.BALLS)[index // 2]
        before = seen.hit & (seen.t < hits.t)
        layer = np.zeros((*seen.id.shape, 4))
        layer[..., :3] = lit(seen, {node.id: paint}, eye, (0, 0, 0), ks=0.5)
        layer[..., 3] = np.where(before, opacity, 0)
        layers.append((shape, layer))
        labels += [before.astype(int), seen.part if pane else seen.hit.astype(int)]
    background = np.concatenate([base, np.ones((*base.shape[:2], 1))], axis=-1)
    ordered = [layer for _, layer in order_of(layers, eye)]
    want = composite(background, *ordered)
    mask = interior(*labels)
    covered = sum((layer[..., 3] > 0).astype(int) for layer in ordered)
    assert (mask & (covered >= 2)).sum() > 5
    assert_close(color, want, "phong", mask=mask)
    assert (color[..., 3] == 1).all()
    # The opposite order would give another picture.
    assert np.abs(composite(background, *ordered[::-1]) - want).max() > 0.05


def test_what_is_behind_the_bunny_is_hidden(renderer):
    """The depth test is on: the bunny hides the panes behind it."""
    program = example.build(document=True)
    for node in program.translucent:
        node.visible = node.id == program.translucent[0].id
    frame = 30  # the first pane stands behind
    picture = example.draw(program, renderer, frame, size=SIZE)
    program.translucent[0].visible = False
    without = example.draw(program, renderer, frame, size=SIZE)
    changed = (picture != without).any(-1)
    ids = renderer.render(program.scene, program.camera, SIZE, outputs=("id",)).id
    assert changed.any()
    assert not changed[ids == program.opaque[1].id].any()


def coverage(renderer, program, frame, size):
    """How many translucent surfaces each pixel shows, and where the bunny is."""
    count = np.zeros((size[1], size[0]), int)
    for node in program.translucent:
        for other in program.translucent:
            other.visible = other is node
        alone = example.draw(program, renderer, frame, size)
        node.visible = False
        count += (alone != example.draw(program, renderer, frame, size)).any(-1)
    for node in program.translucent:
        node.visible = True
    ids = renderer.render(program.scene, program.camera, size, outputs=("id",)).id
    return count, ids == program.opaque[1].id


def test_the_still_shows_layers_over_the_bunny(renderer):
    """A tenth of the picture shows the bunny through a surface, a twentieth through two and more."""
    program = example.build()
    count, bunny = coverage(renderer, program, example.STILL, (128, 128))
    assert (bunny & (count >= 1)).mean() > 0.1
    assert (bunny & (count >= 2)).mean() > 0.05
    assert (count >= 3).mean() > 0.02
    assert 0.2 < (count == 0).mean() < 0.8


@pytest.mark.parametrize("document", [False, True])
def test_the_plain_pair_leaves_holes_in_alpha(any_path, document):
    """Each surface of alpha a makes a a + (1 - a) D of the alpha D: .75 for one of .5."""
    program = example.build("plain", document=document)
    stage = example.DOCUMENT if document else example.STAGED
    opacities = [thing.opacity for thing in stage.things]
    assert 0.5 in opacities
    for shown, a in zip(program.translucent, opacities, strict=True):
        for node in program.translucent:
            node.visible = node is shown
        # A ball shows its front side alone, a pane two of its sides at most; both once in most pixels.
        found = np.concatenate(
            [
                example.draw(program, any_path, frame, SIZE, format="rgba32f")[..., 3].ravel()
                for frame in (0, 30, 60, 90)
            ]
        )
        assert (np.abs(found - (a * a + 1 - a)) < 1e-6).mean() > 0.005
        assert (found == 1).mean() > 0.5
    red = program.translucent[0]
    for node in program.translucent:
        node.visible = node is red
    alpha = example.draw(program, any_path, 50, SIZE, format="rgba32f")[..., 3]
    assert (np.abs(alpha - 0.75) < 1e-6).mean() > 0.005
    example.set_blend(program, "separate")
    assert (example.draw(program, any_path, 50, SIZE, format="rgba32f")[..., 3] == 1).all()


def test_a_web_page_shines_through_the_holes(renderer):
    """The browser adds the page, weighted by 1 - alpha, to colours that count as multiplied already."""
    program = example.build(blend="plain")
    bare = example.draw(program, renderer, 0, SIZE, format="rgba32f").astype(float)
    shown = example.draw(program, renderer, 0, SIZE, page=True, format="rgba32f")
    rows, columns = np.indices(bare.shape[:2])
    # The squares count from the bottom left.
    even = ((SIZE[1] - 1 - rows) // 16 + columns // 16) % 2 == 0
    page = np.where(even, 1.0, 0.45)[..., None]
    want = np.concatenate([bare[..., :3] + (1 - bare[..., 3:]) * page, bare[..., 3:] * 0 + 1], -1)
    assert_close(shown, want, "float32_maths")
    assert np.abs(shown - bare)[..., :3].max() > 0.1
    example.set_blend(program, "separate")
    kept = [
        example.draw(program, renderer, 0, SIZE, page=page, format="rgba32f")
        for page in (False, True)
    ]
    assert_close(kept[1], kept[0], "float32_maths")


def test_other_pairs_are_refused():
    with pytest.raises(ValueError, match='blend: expected "separate" or "plain", got \'none\''):
        example.build(blend="none")  # type: ignore[arg-type]


def test_live_shows_the_page_and_exchanges_the_pairs(renderer):
    with example.live(renderer) as view:
        assert isinstance(view, cc.Viewer)
        view.size = (64, 64)
        view.samples = 1
        closed = view.draw()
        view._answer({"event_type": "key_down", "key": "b"})
        opened = view.draw()
        assert (closed != opened).any(-1).mean() > 0.2
        view._answer({"event_type": "key_down", "key": "b"})
        np.testing.assert_array_equal(view.draw(), closed)
        assert "plain pair" in view.help
