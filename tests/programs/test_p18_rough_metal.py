"""P18: each ball against the reference of glTF's material, and the program's own formula against the renderer."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import rough_metal as example
from cubecam.truth.shading.standard.material import Parameters, Surface
from cubecam.truth.shading.standard.shade import shade
from tests.programs.oracle import near_enough
from tests.reference.lookups import environment_of

SIZE = (144, 72)
#: The size of the photograph, which the test makes itself, with edges and a lamp.
TEXELS = 32


@pytest.fixture(scope="module")
def photograph():
    rng = np.random.default_rng(18)
    coarse = rng.uniform(0.05, 1.5, (6, 8, 8, 3)).astype(np.float32)
    faces = coarse.repeat(TEXELS // 8, axis=1).repeat(TEXELS // 8, axis=2)
    faces[2, 5:8, 9:12] = (30, 25, 20)
    return cc.CubeMap(faces)


def turned(directions, degrees):
    """Directions of the world in the axes of a photograph that was turned about +Y."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return directions @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


@pytest.mark.slow
@pytest.mark.parametrize("multiple_scattering", [True, False])
@pytest.mark.parametrize("frame", [0, 13])
def test_frames(renderer, photograph, frame, multiple_scattering):
    program = example.build(photograph, multiple_scattering=multiple_scattering, detail=64)
    color = example.draw(program, renderer, frame, SIZE, format="rgba32f")[..., :3]
    drawn = renderer.render(
        program.scene, program.camera, SIZE, outputs=("position", "normal", "id")
    )
    levels = photograph.prefilter().levels
    plain = environment_of(levels[0], levels[1:], photograph.irradiance().faces)
    look_up = plain.radiance, plain.irradiance
    degrees = 360 * frame / example.FRAMES
    plain.radiance = lambda d, roughness: look_up[0](turned(d, degrees), roughness)
    plain.irradiance = lambda n: look_up[1](turned(n, degrees))
    want = color.astype(np.float64)
    for number, (metallic, roughness) in enumerate(
        (m, r) for m in (1, 0.5, 0) for r in (0, 0.2, 0.4, 0.6, 0.8, 1)
    ):
        here = drawn.id == program.balls[number].id
        normal = drawn.normal[here].astype(np.float64)
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        v = program.camera.position - drawn.position[here]
        v /= np.linalg.norm(v, axis=-1, keepdims=True)
        want[here] = shade(
            Parameters(
                color=(0.95, 0.64, 0.3),
                metallic=metallic,
                roughness=roughness,
                multiple_scattering=multiple_scattering,
            ),
            Surface(drawn.position[here], v, normal),
            environment=plain,
        )[..., :3]
        near_enough(color, want, here, 2e-3, 1e-2, f"metallic {metallic}, roughness {roughness}")


def test_the_formula_of_the_program_is_the_renderer_s(renderer, photograph):
    program = example.build(photograph)
    off = example.draw(program, renderer, 7, SIZE, show="difference", format="rgba32f")[..., :3]
    assert np.percentile(off / 20, 99) < 4e-3
    assert (off / 20).mean() < 5e-4
    computed = example.draw(program, renderer, 7, SIZE, show="formula")
    assert computed.dtype == np.uint8
    assert computed.shape == (72, 144, 4)


def test_the_formula_feels_the_turn_of_the_photograph(renderer, photograph):
    program = example.build(photograph)
    pictures = [
        example.draw(program, renderer, frame, SIZE, show="formula", format="rgba32f")
        for frame in (0, 20)
    ]
    balls = renderer.render(program.scene, program.camera, SIZE, outputs=("id",)).id > 0
    assert np.abs(pictures[0] - pictures[1])[balls].mean() > 0.05


def test_numbers(photograph):
    program = example.build(photograph)
    materials = [ball.material for ball in program.balls]
    assert all(isinstance(material, cc.StandardMaterial) for material in materials)
    assert [m.roughness for m in materials[:6]] == pytest.approx([0, 0.2, 0.4, 0.6, 0.8, 1])  # type: ignore[union-attr]
    assert [m.metallic for m in materials[::6]] == [1, 0.5, 0]  # type: ignore[union-attr]


def test_wrong_words(renderer, photograph):
    program = example.build(photograph)
    with pytest.raises(ValueError, match='show: expected "picture"'):
        example.draw(program, renderer, 0, SIZE, show="all")  # type: ignore[arg-type]
