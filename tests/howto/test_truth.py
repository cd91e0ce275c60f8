"""docs/howto/truth.md: its program gives what the page says, and its command and its reasons are true."""

import re
import shlex
import shutil

import numpy as np
import pytest
from click.testing import CliRunner

import cubecam as cc
from cubecam.cli import app
from cubecam.truth.scene.refusals import KINDS
from tests.documents import fenced, text_of
from tests.howto.pages import printed

pytestmark = pytest.mark.slow
pytest.importorskip("embreex")

NAME = "docs/howto/truth.md"


def test_the_numbers_are_those_of_the_page(pages):
    _, scope = pages(NAME)
    samples, noise, relative, ssim = map(float, re.findall(r"\d+\.?\d*", printed(NAME)))
    truth, found = scope["truth"], scope["found"]
    assert truth.complete
    assert truth.samples.max() == samples
    assert abs(100 * truth.noise - noise) < 0.1
    assert abs(100 * found.relative_rmse - relative) < 1
    assert abs(found.ssim - ssim) < 0.003


def test_balls_differ_and_the_floor_and_the_sky_do_not(pages):
    _, scope = pages(NAME)
    with cc.Renderer() as renderer:
        seen = renderer.render(
            scope["scene"], scope["camera"], (180, 120), format="rgba32f", outputs=("id",)
        ).id
    error = scope["found"].error
    on_balls = seen > 1
    assert np.median(error[on_balls]) > 0.03
    assert np.median(error[~on_balls]) < 1 / 255


def test_the_command_fails_above_the_limit_and_draws(pages, tmp_path, monkeypatch):
    folder, scope = pages(NAME)
    for path in folder.iterdir():
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    (line,) = fenced(NAME, "sh")
    words = shlex.split(line)[1:]
    result = CliRunner().invoke(app, words)
    limit = float(words[words.index("--fail-above") + 1])
    assert scope["found"].rmse > limit
    assert result.exit_code == 1
    assert "expected an RMSE of at most" in result.output
    assert cc.load_image("compared.png").std() > 20
    words[words.index("--fail-above") + 1] = "9"
    assert CliRunner().invoke(app, words).exit_code == 0


def test_every_refusal_of_the_page_is_one():
    """Each row of the table is refused, and a plain scene is not."""
    camera = cc.PerspectiveCamera(position=(0, 0, 3))

    def render(material):
        scene = cc.Scene()
        scene.add(cc.Mesh.sphere(0.5, 8, 4), material, name="it")
        return cc.truth.render(scene, camera, (4, 4), samples=1)

    assert render(cc.PhongMaterial()).complete
    shown = cc.RenderTexture(cc.Scene(), camera, size=(4, 4))
    shown.effects = [cc.ImageEffect("vec4 effect(vec2 uv) { return vec4(1.0); }")]
    cases = [
        cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(1); }"),
        cc.BasicMaterial(map=shown),
        cc.BasicMaterial(cubemap=cc.Probe((0, 0, 0))),
        cc.PhongMaterial(stencil=cc.Stencil()),
        cc.PhongMaterial(depth_test=False),
        cc.PhongMaterial(color_write=(True, False, True, True)),
        cc.PhongMaterial(depth_write=False),
        cc.PhongMaterial(blend=cc.Blend("dst_color", "zero")),
    ]
    for material in cases:
        with pytest.raises(ValueError, match="'it', material"):
            render(material)
    rows = re.findall(r"^\| (?!refused|---)(.+) \|", text_of(NAME), re.MULTILINE)
    assert len(rows) == 6
    assert len(KINDS) == 5  # another kind that rays follow, or do not, belongs on the page
