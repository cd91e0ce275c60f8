"""docs/howto/own_materials.md: GLSL of one's own, its names and its messages."""

import re

import numpy as np
import pytest

import cubecam as cc
from tests.documents import text_of
from tests.howto.pages import printed

NAME = "docs/howto/own_materials.md"


@pytest.mark.slow
def test_the_pictures_show_stripes_that_move(pages):
    folder, _ = pages(NAME)
    first, later = (cc.load_image(folder / name)[..., :3] for name in ("first.png", "later.png"))
    assert first.shape == (240, 320, 3)
    assert (np.abs(first.astype(int) - later).max(axis=-1) > 20).mean() > 0.05
    column = first[:, 160].astype(int)
    blue = column[:, 2] > column[:, 0] + 40
    assert (blue[1:] != blue[:-1]).sum() >= 6  # at least three stripes


@pytest.mark.slow
def test_the_effect_darkens_the_corners(pages):
    _, scope = pages(NAME)
    with cc.Renderer() as renderer:
        plain = renderer.render(scope["scene"], scope["camera"], **scope["look"])
        soft = renderer.render(
            scope["scene"], scope["camera"], effects=[scope["soft"]], **scope["look"]
        )
    share = soft.color[..., :3].astype(float) / plain.color[..., :3]
    assert share[0, 0].mean() < 0.6
    assert abs(share[120, 160].mean() - 1.2) < 0.01


@pytest.mark.slow
def test_the_message_is_that_of_the_page(pages):
    _, scope = pages(NAME)
    said = re.escape(printed(NAME).strip()).replace(r"\.\.\.", ".*")
    if "surfce" not in scope["message"].split("\n\n")[0]:
        pytest.skip("the page shows the words of Mesa's compiler")
    assert re.fullmatch(said, scope["message"].strip(), re.DOTALL)


@pytest.mark.slow
def test_reload_reads_the_file_again(pages, tmp_path, monkeypatch):
    folder, scope = pages(NAME)
    source = tmp_path / "stripes.glsl"
    source.write_text((folder / "stripes.glsl").read_text())
    material = cc.ShaderMaterial(source, textures={"grain": scope["grain"]})
    assert not material.reload()
    source.write_text("vec3 shade(Surface surface) { return vec3(0.25); }")
    assert material.reload()


def test_every_name_at_hand_exists():
    """The names in the table compile, in one shader that uses all of them."""
    text = text_of(NAME)
    table = text[text.index("| in GLSL |") : text.index("- `shade` may return")]
    names = set(re.findall(r"`(\w+)\(", table)) | set(re.findall(r"`(\w+)`", table)) - {"Surface"}
    source = """
    uniform sampler2D image;
    vec4 shade(Surface surface) {
        vec3 sum = surface.position + surface.normal + surface.incident + surface.position_object;
        sum += surface.normal_object + vec3(surface.uv + surface.uv1, 0.0) + surface.color.rgb;
        sum += surface.tangent.xyz;
        sum += environment_filtered(surface.normal, 0.5) + environment_irradiance(surface.normal);
        sum += vec3(brdf(0.5, 0.5), 0.0) + environment_mip(surface.normal, 1.0);
        sum += environment_at(surface.position, surface.normal);
        sum += environment(surface.normal) + environment_lod(surface.normal, 1.0) + ambient_light();
        if (environment_is_local()) sum += environment_position() * float(environment_levels());
        sum += vec3(environment_size());
        for (int i = 0; i < light_count(); ++i) {
            LightSample light = sample_light(i, surface);
            sum += light.direction * light.radiance;
        }
        sum += phong(surface, vec3(1.0), 0.2, 0.7, 1.0, 10.0) + schlick(surface, 0.04);
        sum += (model_matrix() * vec4(0.0, 0.0, 0.0, 1.0)).xyz + normal_matrix()[0] + eye_position();
        return vec4(sum * texture(image, surface.uv).rgb, 1.0);
    }"""
    missing = {name for name in names if not re.search(rf"\b{name}\b", source)}
    assert not missing, f"this test does not try {missing}"
    material = cc.ShaderMaterial(source, textures={"image": np.ones((1, 1, 3), np.float32)})
    scene = cc.Scene(environment=cc.CubeMap(np.ones((6, 2, 2, 3), np.float32)))
    scene.add(cc.PointLight((1, 2, 3), shadow=True))
    scene.add(cc.Mesh.sphere(0.5), material)
    camera = cc.PerspectiveCamera(position=(0, 0, 2), target=(0, 0, 0))
    with cc.Renderer(device="software") as renderer:
        frame = renderer.render(scene, camera, (16, 16), format="rgba32f", outputs=("id",))
    assert np.isfinite(frame.color).all()
    assert frame.color[8, 8, :3].min() > 0


def test_the_table_names_what_the_docstring_names():
    doc = cc.ShaderMaterial.__doc__
    assert doc is not None
    functions = set(re.findall(r"``(?:\w+ )?(\w+)\((?:\w+ \w+|Surface \w+|\w+|)[,)]", doc))
    table = text_of(NAME)
    assert {name for name in functions if name.startswith("environment")} <= set(
        re.findall(r"`(\w+)\(", table)
    )
