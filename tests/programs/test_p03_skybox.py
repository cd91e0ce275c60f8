"""P3: walking changes no background pixel; the sky is a lookup by direction and lies behind everything."""

import numpy as np

import cubecam as cc
from cubecam.examples import skybox
from tests.compare import assert_close, assert_identical
from tests.gl.world import inner
from tests.programs.oracle import Look, box, looked_up, moved, photographs, predicted

SIZE = (48, 48)
SCRIPT: list[str | tuple[float, float]] = [
    (40, 0),
    (0, 12),
    *["w"] * 8,
    (-30, 5),
    *["s"] * 5,
    (200, 0),
    *["w"] * 20,
]


def sky(look):
    """The direction of every pixel: inverse(projection * view without translation) * clip position."""
    rotation = look.view.copy()
    rotation[:3, 3] = 0
    inverse = np.linalg.inv(look.projection @ rotation)
    x = (np.arange(SIZE[0]) + 0.5) / SIZE[0] * 2 - 1
    y = 1 - (np.arange(SIZE[1]) + 0.5) / SIZE[1] * 2
    y, x = np.meshgrid(y, x, indexing="ij")
    return (np.stack([x, y, np.ones_like(x), np.ones_like(x)], axis=-1) @ inverse.T)[..., :3]


def test_every_frame_is_the_document_s(renderer):
    images = photographs()
    program = skybox.build(images, script=SCRIPT, document=True)
    boxes = [
        box(node, size, moved(*place))
        for node, (_, place, size) in zip(program.scene.nodes, skybox.BOXES, strict=True)
    ]
    seen = set()
    for frame in (0, 1, 2, 10, 11, 16, 17, 30):
        color = skybox.draw(program, renderer, frame, size=SIZE, format="rgba32f")
        place, direction = predicted(SCRIPT[:frame])
        look = Look(place, place + direction, 60, 1, 15, SIZE)
        hits = look.hits(boxes)
        want = looked_up(images, sky(look))
        for node, (paint, _, _) in zip(program.scene.nodes, skybox.BOXES, strict=True):
            want[hits.id == node.id] = paint
        assert_close(color[..., :3], want, "shaded", mask=inner(hits), name=f"frame {frame}")
        seen |= set(np.unique(hits.id))
    assert seen == {0, 1, 2, 3}


def test_walking_changes_no_pixel_of_the_background(renderer):
    program = skybox.build(
        photographs(16), script=[(40, 0), (0, 12), *["w"] * 30, *["s"] * 50], document=True
    )
    alone = skybox.build(photographs(16), script=program.script, boxes=False, document=True)
    first = skybox.draw(alone, renderer, 2, size=SIZE)
    boxes_moved = 0
    for frame in range(2, 82, 8):
        assert_identical(skybox.draw(alone, renderer, frame, size=SIZE), first)
        picture = skybox.draw(program, renderer, frame, size=SIZE)
        ids = renderer.render(program.scene, program.camera, SIZE, outputs=("id",)).id
        assert_identical(picture[ids == 0], first[ids == 0])
        boxes_moved += (ids != 0).any()
    assert boxes_moved
    assert np.linalg.norm(alone.camera.position) > 1  # the camera did walk


def test_turning_moves_it(renderer):
    program = skybox.build(photographs(16), script=[(5, 0)], boxes=False, document=True)
    first = skybox.draw(program, renderer, 0, size=SIZE)
    assert (skybox.draw(program, renderer, 1, size=SIZE) != first).mean() > 0.3


def test_it_is_behind_everything(renderer):
    """A wall just before the far plane hides the sky; just beyond the far plane the wall is not seen."""
    program = skybox.build(photographs(16), boxes=False, document=True)
    wall = program.scene.add(
        cc.Mesh.box((90, 90, 1)), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, 15.4)
    )
    picture = skybox.draw(program, renderer, 0, size=SIZE)
    assert (picture[..., :3] == (255, 0, 0)).all()
    wall.position = (0, 0, 15.6)
    assert not (skybox.draw(program, renderer, 0, size=SIZE)[..., :3] == (255, 0, 0)).all(-1).any()
