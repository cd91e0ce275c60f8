"""The README's Python runs unchanged, and its example of a user's own material gives the picture it promises."""

import re

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.documents import ROOT, python_blocks, run_block, text_of

TEXT = text_of("README.md")
BLOCKS = python_blocks("README.md")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Run a block alone, once; give the names after its run and the folder in which it ran."""
    runs = {}

    def get(index):
        if index not in runs:
            folder = tmp_path_factory.mktemp("block")
            with pytest.MonkeyPatch.context() as patch:
                runs[index] = run_block(BLOCKS[index], "README.md", folder, patch), folder
        return runs[index]

    return get


@pytest.mark.parametrize("index", range(len(BLOCKS)))
def test_every_block_runs_alone(index, done):
    _, folder = done(index)
    saved = set(re.findall(r'save\w*\("([^"]+)"', BLOCKS[index]))
    assert saved
    assert {path.name for path in folder.iterdir()} == saved


@pytest.fixture
def first(done):
    """The names of the first program after its run, and the frame that it wrote."""
    scope, folder = done(0)
    return scope, cc.load_image(folder / "frame.png")


@pytest.mark.slow
def test_the_first_program_writes_a_picture_that_is_neither_dark_nor_clipped(first):
    _, picture = first
    assert picture.shape[:2] == (768, 1024)
    colors = picture[..., :3]
    assert 0.25 < colors.mean() / 255 < 0.75
    assert (colors < 12).mean() < 0.10
    assert (colors > 250).mean() < 0.12


@pytest.mark.slow
def test_the_first_program_shows_shadow_and_ball(first):
    """The bunny's shadow darkens the ground, and the ball, which shows the bunny, covers a tenth of the picture."""
    scope, _ = first
    scene, camera, ball, hero = (scope[name] for name in ("scene", "camera", "ball", "hero"))
    with cc.Renderer(device="software") as renderer:
        lit = renderer.render(scene, camera, (256, 192), format="rgba32f", outputs=("id",))
        hero.cast_shadow = False
        without = renderer.render(scene, camera, (256, 192), format="rgba32f")
        scene.remove(hero)
        alone = renderer.render(scene, camera, (256, 192), format="rgba32f", outputs=("id",))
    ground = ~np.isin(lit.id, (0, ball.id, hero.id))
    darker = lit.color[..., 0] < 0.7 * without.color[..., 0]
    assert (darker & ground).mean() > 0.02
    on_ball = (lit.id == ball.id) & (alone.id == ball.id)
    assert on_ball.mean() > 0.1
    changed = np.abs(lit.color - alone.color).max(axis=2) > 0.05
    assert (changed & on_ball).sum() > 0.02 * on_ball.sum()


def test_its_pictures_are_there_before_the_first_code():
    above = TEXT[: TEXT.index("```")]
    pictures = re.findall(r"!\[([^\]]+)\]\(([^)]+)\)", TEXT)
    assert len(pictures) == 3
    assert len({path for _, path in pictures}) == 3
    for words, path in pictures:
        assert f"]({path})" in above
        assert len(words) > 40  # says what is shown
        assert (ROOT / path).stat().st_size <= 200_000
        picture = cc.load_image(ROOT / path)
        assert picture.shape[1] == 1024
        assert picture.std() > 30
    others = ("howto-", "why-")
    folder = [p for p in (ROOT / "docs/images").iterdir() if not p.name.startswith(others)]
    assert {f"docs/images/{path.name}" for path in folder} == {path for _, path in pictures}


@pytest.mark.slow
def test_its_first_picture_is_what_the_first_program_writes(first):
    shown = cc.load_image(ROOT / "docs" / "images" / "frame.jpg").astype(float)
    drawn = first[1][..., :3].astype(float)
    assert np.abs(shown - drawn).mean() < 2  # JPEG, and another driver's roundings


def test_the_material_of_ones_own_is_the_mirror_it_says(done):
    (index,) = [i for i, block in enumerate(BLOCKS) if "ShaderMaterial" in block]
    scope, folder = done(index)
    own, head, scene, camera = (scope[name] for name in ("gold", "head", "scene", "camera"))
    own.uniforms["share"] = 1
    with cc.Renderer(device="software") as renderer:
        got = renderer.render(scene, camera, (64, 64), format="rgba32f", outputs=("id",))
        head.material = cc.MirrorMaterial(tint=own.uniforms["color"])
        want = renderer.render(scene, camera, (64, 64), format="rgba32f")
    assert (got.id == head.id).mean() > 0.2
    assert_close(got.color, want.color, "lookup")
    picture = cc.load_image(folder / "gold.png")
    assert picture.shape == (512, 512, 4)
    red, _, blue = picture[192:256, 192:320, :3].astype(int).T
    assert (red > blue).mean() > 0.95  # gold
    assert np.ptp(red) > 100


def test_it_says_where_it_runs():
    above = TEXT[: TEXT.index("```python")]
    for words in ("**Linux**", "macOS and Windows", "Docker or WSL", "OpenGL 4.5"):
        assert words in above
