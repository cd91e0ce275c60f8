"""The staged scenes of P1 to P6: what their pictures must show, in pixels, and the options of the documents."""

import numpy as np
import pytest

import cubecam as cc
from cubecam import examples
from cubecam.examples import (
    _common,
    arriving_faces,
    inside_the_box,
    model_space_reflection,
    reflection_and_refraction,
    skybox,
    textured_cube,
)
from tests.compare import assert_close, assert_identical
from tests.gl.world import inner
from tests.programs.oracle import GREY, Look, box, looked_up, photographs, rx, ry, scaled

SIZE = (64, 64)


def still(module, program, renderer, size=None, **options):
    size = examples.size_of(module, program) if size is None else size
    frame = examples.still_of(module, program)
    return module.draw(program, renderer, frame, size=size, **options)


def shares(program, renderer, size=(128, 128)):
    """The share of the picture that each node covers, by its id; 0 is the background."""
    ids = renderer.render(program.scene, program.camera, size, outputs=("id",)).id
    return {int(one): float((ids == one).mean()) for one in np.unique(ids)}


def detail(picture):
    """The mean step from a pixel to its right neighbour, of 255."""
    return np.abs(np.diff(picture[..., :3].astype(float).mean(axis=-1), axis=1)).mean()


# ----- the photographs


def plain(sample):
    """The photographs without enlarging and sharpening: linear interpolation of the panorama."""
    light = cc.load_environment(cc.sample_data(sample), size=512, dtype="float32")
    return cc.to_screen(light)[..., :3]


@pytest.mark.parametrize("sample", ["forest.exr", "interior.exr", "sunset.exr"])
def test_photographs_show_the_place_and_are_sharper(sample):
    faces = np.stack(_common.photographs(sample=sample)).astype(float)
    other = plain(sample).astype(float)
    assert faces.shape == (6, 512, 512, 3)
    # Averages of 32 x 32 pixels are the same place, not shifted or turned. Tone mapping before the resampling makes a
    # sun between leaves a little darker.
    coarse = [f.reshape(6, 16, 32, 16, 32, 3).mean(axis=(2, 4)) for f in (faces, other)]
    assert np.abs(coarse[0] - coarse[1]).mean() < 4
    # -X, -Z, +X, +Z: the sky and the ground are smooth in some photographs.
    for face in (0, 1, 4, 5):
        assert detail(faces[face]) > 1.25 * detail(other[face])


def test_photographs_have_no_seam_where_the_panorama_ends(monkeypatch):
    """Its borders meet in the middle of the face +Z. Turned by 90 degrees, the panorama has them elsewhere."""
    panorama = cc.load_image(cc.sample_data("sunset.exr"))
    faces = _common._developed.__wrapped__("sunset.exr")
    monkeypatch.setattr(cc, "load_image", lambda path: np.roll(panorama, 256, axis=1))
    turned = _common._developed.__wrapped__("sunset.exr")
    same = [k for k in (0, 1, 5) if np.abs(turned[k].astype(int) - faces[4]).max() <= 1]
    assert len(same) == 1


def test_files_of_light_are_made_for_a_screen(tmp_path):
    light = (photographs(16) * 30).astype(np.float32)
    cc.CubeMap(light).save(tmp_path / "{face}.exr", layout="faces")
    want = cc.to_screen(cc.CubeMap(light))[..., :3]
    for images in (
        str(tmp_path / "{face}.exr"),
        [tmp_path / f"{face}.exr" for face in ("px", "nx", "py", "ny", "pz", "nz")],
    ):
        got = _common.photographs(images)
        assert got[0].dtype == np.uint8
        np.testing.assert_allclose(np.stack(got)[..., :3].astype(int), want, atol=1)


# ----- P1


def test_p1_fills_the_picture_and_stays_in_it(renderer):
    program = textured_cube.build()
    still(textured_cube, program, renderer, SIZE)
    found = shares(program, renderer)
    assert 0.4 < found[program.cube.id] < 0.6
    ids = renderer.render(program.scene, program.camera, (128, 128), outputs=("id",)).id
    assert not any(edge.any() for edge in (ids[0], ids[-1], ids[:, 0], ids[:, -1]))


@pytest.mark.parametrize(
    ("options", "frame", "angle_x", "angle_y"),
    [
        ({"angles": (120, -35)}, 0, 120, -35),
        ({"angles": (120, -35)}, 10, 150, -5),
        ({"angles": (0, 10), "script": "drag 51.2 0; drag 0 -102.4"}, 4, 10, 10),
        ({"angles": (0, 10), "script": "drag 51.2 0; drag 0 -102.4"}, 11, 10, -10),
    ],
    ids=["angles", "turned", "first drag", "both drags"],
)
def test_p1_at_any_angles(renderer, options, frame, angle_x, angle_y):
    """Rx(angleY) Ry(angleX) scale(2), against numpy."""
    images = photographs()
    program = textured_cube.build(images, document=True, **options)
    color = textured_cube.draw(program, renderer, frame, size=SIZE, format="rgba32f")
    hits = Look((0, 0, 7), (0, 0, 0), 60, 1, 15, SIZE).hits(
        [box(program.cube, 2, rx(angle_y) @ ry(angle_x) @ scaled(2))]
    )
    want = np.where(hits.hit[..., None], looked_up(images, hits.local), GREY)
    assert_close(color[..., :3], want, "shaded", mask=inner(hits), least=0.6)


def test_p1_has_no_walker():
    with pytest.raises(ValueError, match=r'script: expected drags only.*got "w"'):
        textured_cube.build(photographs(8), script="drag 3 4; w 2")
    assert textured_cube.build(photographs(8), script="drag 3 4").frames == 2


# ----- P2 and P3


@pytest.mark.parametrize("module", [inside_the_box, skybox])
def test_the_photograph_is_sharp(module, renderer):
    """Four times as much detail as the document's still, and much more than without sharpening."""
    program = module.build()
    shown = detail(still(module, program, renderer))
    cube = cc.CubeMap(plain("forest.exr"), mipmaps=module is inside_the_box)
    assert shown > 1.3 * detail(still(module, module.build(cube.faces), renderer))
    document = module.build(document=True)
    assert shown > 4 * detail(still(module, document, renderer))


def test_p2_is_inside_at_the_still_and_outside_at_the_end(renderer):
    program = inside_the_box.build()
    still(inside_the_box, program, renderer, SIZE)
    found = shares(program, renderer, (512, 512))
    assert 0 not in found
    assert 0.9 < found[program.scene.nodes[0].id] < 0.999  # the rest are the lines at the edges
    inside_the_box.draw(program, renderer, program.frames - 1, size=SIZE)
    assert np.abs(program.camera.position).max() > 2
    assert 0.2 < shares(program, renderer)[0] < 0.8


def test_p3_shows_its_boxes_before_the_sky(renderer):
    program = skybox.build()
    still(skybox, program, renderer, SIZE)
    found = shares(program, renderer)
    boxes = [node.id for node in program.scene.nodes if node.mesh is not None]
    assert len(boxes) == 3
    assert all(found[one] > 0.01 for one in boxes)
    assert found[0] > 0.8


def test_p3_walks_without_moving_the_staged_sky(renderer):
    """Before and after the first 25 steps, the pictures agree wherever no box is."""
    program = skybox.build(photographs(16))
    first = program.script.index("w")
    assert program.script[first : first + 25] == ("w",) * 25
    pictures, ids = [], []
    for frame in (first, first + 25):
        pictures.append(skybox.draw(program, renderer, frame, size=SIZE))
        ids.append(renderer.render(program.scene, program.camera, SIZE, outputs=("id",)).id)
    both = (ids[0] == 0) & (ids[1] == 0)
    assert 0.3 < both.mean() < 0.99
    assert_identical(pictures[0][both], pictures[1][both])
    assert (ids[0] != ids[1]).any()


def test_a_text_and_its_events_are_one_walk(renderer):
    for module in (inside_the_box, skybox):
        text = module.build(photographs(8), script="drag 25.6 0; w 2; s")
        events = module.build(photographs(8), script=[(2.5, 0), (2.5, 0), "w", "w", "s"])
        assert text.script == events.script
        assert (text.frames, text.still) == (6, 5)
        pictures = [module.draw(p, renderer, 5, size=(24, 24)) for p in (text, events)]
        assert_identical(*pictures)


# ----- P4


def test_p4_shows_large_objects(renderer):
    """Each ball covers a tenth of the picture or more, each teapot 4 %."""
    program = reflection_and_refraction.build()
    still(reflection_and_refraction, program, renderer, SIZE)
    found = shares(program, renderer)
    for ball, pot in (program.mirrors, program.glass):
        assert found[ball.id] > 0.1
        assert found[pot.id] > 0.04


# ----- P5


def test_p5_gets_a_photograph_a_second(renderer):
    """A second is 25 frames, as in the files of `cubecam example`."""
    images = [np.full((8, 8, 3), 20 * k, np.uint8) for k in range(6)]
    program = arriving_faces.build(images)
    assert (program.cubemap.size, program.frames) == (8, 350)
    for frame in (0, 24, 25, 49, 50, 100, 149, 150, 174, 175, 199, 200, 349, 3):
        arriving_faces.draw(program, renderer, frame, size=(8, 8))
        count = frame % 175 // 25
        there = program.stage.order[: min(count, 6)]
        faces = program.cubemap.faces
        for face in range(6):
            want = 20 * face if face in there else 102
            assert (faces[face] == want).all(), (frame, face)
        assert program.arrived == count
    assert sorted(program.stage.order) == list(range(6))


def test_p5_shows_a_side_that_waits_beside_one_that_is_there(renderer):
    program = arriving_faces.build()
    picture = still(arriving_faces, program, renderer, (256, 256)).astype(int)
    ids = renderer.render(program.scene, program.camera, (256, 256), outputs=("id",)).id
    grey = np.rint(102 * np.array(program.stage.tint))
    waits = (np.abs(picture[..., :3] - grey) <= 1).all(axis=-1)
    cube = ids == program.cube.id
    assert cube.mean() > 0.2
    assert 0.15 < waits[cube].mean() < 0.6
    assert waits[~cube].mean() < 0.05  # the background's photograph is there


def test_p5_is_never_cut_by_the_near_plane():
    program = arriving_faces.build(np.zeros((6, 4, 4, 3), np.uint8))
    corner = np.sqrt(3) / 2
    assert np.linalg.norm(program.camera.position) - corner > program.camera.near


def test_p5_says_how_many_are_there(renderer):
    program = arriving_faces.build()
    shown = arriving_faces.draw(program, renderer, 0, size=(256, 256))
    assert (shown[:40, :200, :3] > 200).all(axis=-1).sum() > 100  # white letters on black
    assert (shown[-40:, :, :3] == 0).all()


# ----- P6


def test_p6_has_a_row_that_agrees_and_one_that_does_not(renderer):
    program = model_space_reflection.build()
    still(model_space_reflection, program, renderer, (96, 48))
    even, stretched = program.pairs
    worst = [
        model_space_reflection.degrees_apart(program.camera, pair.model).max()
        for pair in (even, stretched)
    ]
    assert worst[0] < 0.2
    assert 60 < worst[1] < 73.8
    np.testing.assert_allclose(stretched.model.scale, (2, 1, 1))


@pytest.mark.parametrize("row", [0, 1])
def test_p6_reflects_each_row_as_it_says(renderer, row):
    """Both teapots in one place: the same picture above, another one below."""
    program = model_space_reflection.build()
    pair = program.pairs[row]
    pair.world.position = pair.model.position
    pictures = []
    for shown, hidden in ((pair.model, pair.world), (pair.world, pair.model)):
        shown.visible, hidden.visible = True, False
        pictures.append(still(model_space_reflection, program, renderer, (384, 192)).astype(int))
    ids = renderer.render(program.scene, program.camera, (384, 192), outputs=("id",)).id
    apart = np.abs(pictures[0] - pictures[1]).max(axis=-1)[ids == pair.world.id]
    if row == 0:
        assert np.median(apart) <= 1
    else:
        assert np.median(apart) > 20


def test_p6_shows_the_picture_that_it_was_given(renderer):
    image = np.zeros((48, 64, 3), np.uint8)
    image[16:32] = (250, 30, 40)  # the row of four faces
    program = model_space_reflection.build(image)
    shown = still(model_space_reflection, program, renderer, (384, 192))
    plane = program.scene.nodes[-1].id
    ids = renderer.render(program.scene, program.camera, (384, 192), outputs=("id",)).id
    cells = shown[ids == plane][:, :3]
    red = (cells == (250, 30, 40)).all(axis=-1).mean()
    assert abs(red - 1 / 3) < 0.03
    assert (cells == 0).all(axis=-1).mean() > 0.6


def test_p6_has_four_labels(renderer):
    program = model_space_reflection.build()
    shown = still(model_space_reflection, program, renderer)
    height, width = shown.shape[:2]
    for rows in (slice(0, 30), slice(height - 30, height)):
        for columns in (slice(0, width // 4), slice(3 * width // 4, width)):
            assert (shown[rows, columns, :3] > 230).all(axis=-1).sum() > 100
