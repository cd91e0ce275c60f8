"""What vertex shaders compute is the same, bit for bit, in every program that is made of their source."""

import re
from pathlib import Path

import pytest

SHADERS = Path(__file__).resolve().parents[2] / "shaders"
SOURCES = sorted(SHADERS.rglob("*.vert"))

#: The right side of an assignment that only copies: an attribute, a uniform, or a part of one.
COPY = re.compile(
    r"[au]_\w+(\[\w+\])?(\.\w+)*|own\.\w+|ivec2\(u_\w+, u_\w+\)|rows\[\d\]|mat3\(a_view_matrix\)"
)


def text_of(path):
    return re.sub(r"//[^\n]*", "", path.read_text())


def computed(source):
    """Return the values for the fragment shader that a source computes, except copies."""
    found = re.findall(r"^\s*(v_\w+)(?:\[\w+\])? = (.+);$", source, re.MULTILINE)
    return {name for name, value in found if not COPY.fullmatch(value.strip())}


def test_there_are_vertex_shaders():
    names = {path.name for path in SOURCES}
    assert {"surface.vert", "shadow.vert", "skybox.vert", "full_screen.vert"} <= names


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_what_a_vertex_shader_computes_is_invariant(path):
    """OpenGL promises equal values of two programs only for `invariant` outputs (GLSL 4.50, section 4.8.1)."""
    source = text_of(path)
    names = {"gl_Position"} | computed(source)
    invariant = set(re.findall(r"^invariant (\w+);$", source, re.MULTILINE))
    assert invariant == names
    # A redeclaration comes before the first use (the same section).
    assert source.index("invariant gl_Position;") < source.index("void main")


def test_the_values_of_a_surface_that_are_computed():
    surface = text_of(SHADERS / "passes" / "surface.vert")
    assert computed(surface) == {
        *("v_position", "v_normal", "v_height", "v_tangent", "v_scale"),
        *("v_body", "v_to_body", "v_clip_depth"),
    }
    assert "precise vec4 position_world = " in surface
