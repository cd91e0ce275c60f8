"""P11: all parts of one pass against ray casting; formats are tested by their steps, shadows by rays to the lamp."""

import numpy as np
import pytest

from cubecam.examples import framebuffer_parts as example
from cubecam.truth import shading
from tests.compare import assert_close
from tests.programs.oracle import LAMP, Look, box, mesh, moved, quad, ry, unbroken
from tests.reference import raycast
from tests.reference.raycast import interior

SIZE = (64, 56)
NEAR, FAR = 1, 20
EYE = np.array([0, 2.5, 5.0])
#: Offsets in world units: a point of the ground itself, and points round it as far as the lamp's
#: filter may reach there.
AROUND = np.array(
    [(0.0, 0.0, 0.0)]
    + [(r * np.cos(a), 0, r * np.sin(a)) for r in (0.07, 0.15) for a in np.arange(8) * np.pi / 4]
)
COLORS = [(0.6, 0.6, 0.7), (0.4, 1, 0.4), (1, 0.4, 0.4), (0.4, 0.4, 1)]


def shapes_of(program, frame):
    """The ground, bunny, teapot and box, placed by the document's numbers."""
    bunny, teapot, cube = program.things
    places = [ry(3 * frame) @ ry(120 * i) @ moved(1.4, 0, 0) @ ry(-120 * i) for i in range(3)]
    return [
        quad(program.ground, 8, moved(0, -0.6, 0)),
        mesh(bunny, places[0], ("bunny", 1.2)),
        mesh(teapot, places[1], ("teapot", 1.2)),
        box(cube, 0.8, places[2]),
    ]


@pytest.fixture(scope="module")
def drawn(shared_renderers):
    made = {}

    def get(frame):
        if frame not in made:
            program = example.build(document=True)
            shapes = shapes_of(program, frame)
            look = Look(EYE, (0, 0, 0), 45, NEAR, FAR, SIZE)
            parts = example.parts(program, shared_renderers(None), frame, SIZE)
            made[frame] = program, parts, shapes, look, look.hits(shapes)
        return made[frame]

    return get


frames = pytest.mark.parametrize("frame", [0, 50])


@frames
def test_outputs_of_one_pass(drawn, frame):
    _, parts, _, look, hits = drawn(frame)
    mask = unbroken(hits) & interior(hits.id, hits.part // 1000)
    assert mask.mean() > 0.3
    assert (parts["id"][mask] == hits.id[mask]).all()
    assert_close(parts["distance"], hits.distance, "distance", mask=mask)
    z = -((look.view[:3, :3] @ np.nan_to_num(hits.position)[..., None])[..., 0] + look.view[:3, 3])[
        ..., 2
    ]
    assert_close(parts["z"], np.where(hits.hit, z, np.inf), "distance", mask=mask)
    assert_close(parts["position"], hits.position, "position", mask=mask)
    # Only ground and box have flat sides; normals of bunny and teapot change within a pixel.
    flat = mask & np.isin(hits.id, [1, 5])
    assert_close(
        parts["normal"], np.where(hits.hit[..., None], hits.normal, 0), "normal", mask=flat
    )


@frames
def test_depth_of_16_bits_is_the_quantised_window_depth(drawn, frame):
    _, parts, _, _, hits = drawn(frame)
    z = parts["z"].astype(float)
    window = np.where(np.isfinite(z), FAR / (FAR - NEAR) * (1 - NEAR / z), 1.0)
    steps = parts["depth"].astype(float) * 65535
    assert np.abs(steps - np.rint(steps)).max() < 0.01, "whole steps of 65,535"
    assert_close(parts["depth"], np.rint(window * 65535) / 65535, "depth16")
    assert_close(parts["depth_only"], window, "depth32")
    assert (parts["depth"][~hits.hit & interior(hits.id)] == 1).all()


@frames
def test_colors_of_16_bits_are_the_quantised_ones(drawn, frame):
    _, parts, *_ = drawn(frame)
    levels = np.array([31, 63, 31])
    steps = parts["rgb565"][..., :3] / 255 * levels
    assert np.abs(steps - np.rint(steps)).max() < 0.13, "what 5 or 6 bits can say, in 8"
    exact = parts["color"][..., :3] / 255 * levels
    # GL requires rounding to the nearest step; llvmpipe cuts. The exact values are rounded to half a step of 255.
    assert np.abs(np.rint(steps) - exact).max() < 1 + 0.5 * 63 / 255
    assert (parts["rgb565"][..., 3] == 255).all()
    assert len(np.unique(parts["rgb565"][..., 0])) <= 32


@frames
def test_the_stencil_counts_what_covers_a_pixel(drawn, frame):
    """The stencil counts front faces, hidden or not; rays through the ground and the box give the same number."""
    program, parts, shapes, look, hits = drawn(frame)
    alone = [look.hits([shape]) for shape in shapes]
    others = np.zeros(hits.id.shape, bool)
    for hit in alone[1:3]:
        others |= hit.hit
    mask = interior(
        alone[0].hit.astype(int), alone[3].part, alone[3].hit.astype(int), others.astype(int)
    )
    want = alone[0].hit.astype(int) + alone[3].hit.astype(int)
    simple = mask & ~others
    assert (simple & (want == 2)).sum() > 5
    assert (parts["stencil"][simple] == want[simple]).all()
    assert (parts["stencil"] >= hits.hit)[mask].all()
    assert program.things[2].material.stencil.depth_fail == "incr"


@pytest.mark.slow
@frames
def test_the_shadow_against_ray_casting(drawn, frame):
    """Rays go from each point to the lamp; where the filter mixes free and blocked rays, pixels are masked."""
    _, parts, shapes, _, hits = drawn(frame)
    seen = hits.hit
    start = hits.position[seen]
    blocked, soft = np.zeros(seen.shape, int), np.zeros(seen.shape, int)
    for offset in AROUND:
        beside = start + offset
        hit = raycast.cast(solid(shapes), beside, np.asarray(LAMP.position) - beside, 0.01, 1).hit
        soft[seen] += hit
        if not offset.any():
            blocked[seen] = hit
    hard = (soft == 0) | (soft == len(AROUND))
    lit = unlit = np.zeros((*seen.shape, 3))
    lit, unlit = lit.copy(), unlit.copy()
    for shape, color in zip(shapes, COLORS, strict=True):
        rows = hits.id == shape.id
        shine = 0.0 if shape.id == 1 else 1.0
        lit[rows] = shading.phong(
            hits.position[rows], hits.normal[rows], EYE, color, [LAMP], ks=shine
        )
        unlit[rows] = 0.2 * np.array(color)
    want = np.where(blocked[..., None] == 1, unlit, lit)
    ground = (hits.id == 1) & interior(hits.id, blocked) & hard
    assert (ground & (blocked == 1)).sum() > 5
    assert (ground & (blocked == 0)).sum() > 100
    assert_close(parts["color"][..., :3] / 255, want, "unorm8_phong", mask=ground, least=0.05)
    # The box is compared, too: its sides that face away from the lamp are dark without any map.
    side = (hits.id == 5) & interior(hits.id, hits.part, blocked) & hard
    assert side.sum() > (20 if frame == 0 else 2)
    assert_close(parts["color"][..., :3] / 255, want, "unorm8_phong", mask=side, least=0.0005)


def solid(shapes):
    """The shapes, made double-sided so that they stop light from either side."""
    for shape in shapes:
        shape.double_sided = True
    return shapes


@frames
def test_the_lamps_map_holds_distances(drawn, frame):
    """The map holds distances from the lamp; its face -Y looks straight down and sees the ground and the things."""
    _, parts, shapes, *_ = drawn(frame)
    shadow = parts["shadow"]
    assert shadow.shape == (6, example.SHADOW, example.SHADOW)
    assert np.isinf(shadow[[0, 2, 4]]).all(), "nothing stands beyond or above the lamp"
    assert np.isfinite(shadow[3]).any()
    finite = shadow[3][np.isfinite(shadow[3])]
    assert finite.max() <= 5.6 + 1e-3, "the ground lies 5.6 below"
    assert finite.min() < 5, "and things stand on it"
    assert solid(shapes)


@frames
@pytest.mark.parametrize("document", [False, True])
def test_the_colour_is_the_product_of_the_shaders_own_outputs(shared_renderers, document, frame):
    """Paint times light is the colour, except for highlights: one pass fills all colour buffers."""
    program = example.build(document=document)
    parts = example.parts(program, shared_renderers(None), frame, SIZE)
    seen = parts["id"] > 0
    paints = {program.ground.id: (0.6, 0.6, 0.7) if document else (0.85, 0.82, 0.75)}
    paints |= {node.id: color for node, color in zip(program.things, COLORS[1:], strict=True)}
    want = np.zeros((*seen.shape, 3))
    for number, paint in paints.items():
        want[parts["id"] == number] = paint
    assert_close(parts["paint"], want, "float32_maths")
    assert (parts["light"][~seen] == 0).all()
    assert parts["light"].max() <= (0.9 if document else 1.0) + 1e-3, "ka + kd, no highlights"
    ground = parts["id"] == program.ground.id  # which has no highlights
    product = parts["paint"].astype(float) * parts["light"]
    assert_close(parts["color"][..., :3] / 255, product, "unorm8_phong", mask=ground)
    color = np.clip(product, 0, 1)
    rest = parts["color"][..., :3] / 255 - color
    assert (rest[seen] > -0.01).all()
    assert (rest[seen & ~ground] > 0.05).any(), "bunny and teapot have highlights"


@pytest.mark.slow
@frames
def test_the_light_is_phong_without_colour(drawn, frame):
    """The shader's own output against the formula, where the lamp reaches the surface for certain."""
    _, parts, shapes, _, hits = drawn(frame)
    want = np.zeros((*hits.id.shape, 3))
    for shape in shapes:
        rows = hits.id == shape.id
        want[rows] = shading.phong(
            hits.position[rows], hits.normal[rows], EYE, (1, 1, 1), [LAMP], ks=0
        )
    dark = np.abs(parts["light"] - 0.2).max(-1) < 1e-3
    reached = parts["light"][..., 0] > 0.99 * want[..., 0]
    # At the border of a shadow the filter mixes both.
    ground = (hits.id == shapes[0].id) & interior(hits.id, dark.astype(int), reached.astype(int))
    lit = ground & reached
    assert lit.sum() > 100
    assert_close(parts["light"], want, "phong", mask=lit, least=0.02)
    assert (ground & dark).sum() > 5, "and shadows have the ambient share alone"


@pytest.mark.parametrize("document", [False, True])
def test_the_picture_has_twelve_cells(renderer, document):
    picture = example.draw(example.build(document=document), renderer, example.STILL, (320, 240))
    assert picture.shape == (240, 320, 4)
    cells = [cell for row in np.split(picture, 3) for cell in np.split(row, 4, axis=1)]
    assert all(np.ptp(cell[..., :3]) > 30 for cell in cells)
    assert len({cell.tobytes() for cell in cells}) == 12


def test_each_cell_has_its_name(renderer):
    """Letters, white with a dark edge, stand in the upper left corner of each cell that has room for them."""
    program = example.build()
    named = example.draw(program, renderer, 0, example.SIZE)
    for row in np.split(named, 3):
        for cell in np.split(row, 4, axis=1):
            corner = cell[4:20, 4:120, :3].reshape(-1, 3).astype(int)
            assert (corner.min(-1) > 230).sum() > 12
            assert (corner.max(-1) < 70).sum() > 12
    small = example.draw(program, renderer, 0, (280, 210))  # cells of 70 pixels have no room
    plain = example.parts(program, renderer, 0, (70, 70))["color"]
    np.testing.assert_array_equal(small[:70, :70, :3], plain[..., :3])


def test_the_still_shows_its_things(renderer):
    """Staged: a fifth of each picture are the things, and the shadow map is one picture that holds them all."""
    program = example.build()
    parts = example.parts(program, renderer, example.STILL, (256, 256))
    things = np.isin(parts["id"], [node.id for node in program.things])
    assert things.mean() > 0.15
    assert (parts["color"][..., :3] == 255).any(-1).mean() < 0.02
    shadow = parts["shadow"]
    assert shadow.shape == (1, example.SHADOW, example.SHADOW)
    assert np.isfinite(shadow).mean() > 0.5
    dark = (parts["id"] == program.ground.id) & (parts["light"][..., 0] < 0.31)
    assert dark.mean() > 0.02, "there are shadows"


def test_live_draws_all_parts_and_picks_in_each(renderer):
    with example.live(renderer) as view:
        view.size, view.samples = (320, 240), 1
        drawn = view.draw()
        program = example.build()
        np.testing.assert_array_equal(drawn, example.draw(program, renderer, 0, (320, 240)))
        ids = example.parts(program, renderer, 0, (80, 80))["id"]
        rows, columns = np.nonzero(ids == program.things[2].id)
        y, x = int(np.median(rows)), int(np.median(columns))
        found = [view.pick(x + 80 * i + 0.5, y + 80 * j + 0.5) for i in range(4) for j in range(3)]
        assert len({one.node.id for one in found}) == 1  # type: ignore[union-attr]
        assert view.pick(400, 20) is None
        view.output = "id"
        assert view.draw().shape == (240, 320, 4)
