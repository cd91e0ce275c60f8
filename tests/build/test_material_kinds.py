"""A kind of material that leaves something out does not compile, and the compiler says what is missing."""

import json
import os
import shlex
import subprocess
import sys

import pytest

from tests.build.tools import ROOT, run, tool

pytestmark = pytest.mark.build

#: The parts of a complete kind. The key is the name that the compiler must report if the part is
#: left out.
PARTS = {
    "name": 'static constexpr const char* name = "ToyMaterial";',
    "shader": 'static constexpr const char* shader = "materials/toy.glsl";',
    "fields": """static constexpr auto fields = std::tuple{
        Field{"color", &Toy::color, "ndarray (4,) float32."},
        Field{"weight", &Toy::weight, "float."},
        Field{"limit", &Toy::limit, "float or None."},
        Field{"map", &Toy::map, MapAlpha::counts, "Image or None."},
        Field{"cubemap", &Toy::cubemap, "CubeMap or None."},
        Field{"source", &Toy::source, "str."},
        Field{"inputs", &Toy::inputs, "mapping."},
        Field{"flag", &Toy::flag, "bool."},
    };""",
    "check": "void check() const {}",
    "alpha": "float alpha() const { return color.a; }",
    "constants": """std::array<glm::vec4, 3> constants(const glm::vec3& ambient) const {
        return {color, glm::vec4(weight), glm::vec4(ambient, 1.0F)};
    }""",
    "switches": 'std::array<Switch, 1> switches() const { return {{{"FLAG", flag}}}; }',
    "uses_environment": "bool uses_environment() const { return false; }",
    "uses_lights": "bool uses_lights() const { return true; }",
    "uses_vertex_colors": """VertexColors uses_vertex_colors() const {
        return VertexColors::ignored;
    }""",
    "user_code": "UserCode user_code() const { return {&source, &source, &inputs, limit}; }",
    "operator==": "bool operator==(const Toy&) const = default;",
}

#: The members of the struct, in the order of the fields.
MEMBERS = {
    "color": "glm::vec4 color{1.0F};",
    "weight": "float weight = 1.0F;",
    "limit": "std::optional<float> limit;",
    "map": "MapSource map;",
    "cubemap": "CubeSource cubemap;",
    "source": "UserSource source;",
    "inputs": "ShaderInputs inputs;",
    "flag": "bool flag = false;",
}


def toy(parts=PARTS, members=MEMBERS):
    body = "\n    ".join([*members.values(), "", *parts.values()])
    return f"""#include "cubecam/materials/material.hpp"
namespace cubecam {{
struct Toy {{
    {body}
}};
static_assert(kinds::check_kind<Toy>());
#ifdef WHOLE
static_assert(MaterialKind<Toy>);
std::shared_ptr<Material> make() {{ return std::make_shared<MaterialOf<Toy>>(); }}
#endif
}}  // namespace cubecam
"""


@pytest.fixture(scope="module")
def compiler(tmp_path_factory):
    """A function that compiles a source text with the options that CMake gives to a source of the core."""
    folder = tmp_path_factory.mktemp("compiler")
    run(
        tool("cmake"), "-S", ROOT, "-B", folder, "-G", "Ninja",
        f"-DCMAKE_MAKE_PROGRAM={tool('ninja')}", f"-DPython_EXECUTABLE={sys.executable}",
        "-DCUBECAM_BUILD_MODULE=OFF", "-DCUBECAM_UNITY=OFF", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
    )  # fmt: skip
    commands = json.loads((folder / "compile_commands.json").read_text())
    (one,) = (c for c in commands if c["file"].endswith("cubecam/materials/material.cpp"))
    words = shlex.split(one["command"])
    words = words[: words.index("-o")]

    def compile_text(text, *options):
        source = folder / f"toy_{os.urandom(4).hex()}.cpp"
        source.write_text(text)
        return subprocess.run(
            [*words, "-fsyntax-only", *options, str(source)],
            cwd=folder,
            env={**os.environ, "LC_ALL": "C"},
            capture_output=True,
            text=True,
            check=False,
        )

    return compile_text


def without(parts, name):
    return {key: text for key, text in parts.items() if key != name}


def test_the_complete_kind_compiles(compiler):
    done = compiler(toy(), "-DWHOLE")
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("missing", PARTS)
def test_a_kind_without_a_part_is_refused(compiler, missing):
    done = compiler(toy(without(PARTS, missing)))
    assert done.returncode != 0
    assert "a material kind" in done.stderr, done.stderr
    said = [line for line in done.stderr.splitlines() if "static assertion failed" in line]
    assert any(missing in line for line in said), done.stderr


@pytest.mark.parametrize("forgotten", MEMBERS)
def test_a_member_without_a_field_is_refused(compiler, forgotten):
    lines = PARTS["fields"].splitlines()
    kept = [line for line in lines if f'Field{{"{forgotten}"' not in line]
    assert len(kept) == len(lines) - 1
    parts = {**PARTS, "fields": "\n".join(kept)}
    done = compiler(toy(parts))
    assert done.returncode != 0
    assert "must list every member of the struct once" in done.stderr, done.stderr


def test_a_field_twice_is_refused(compiler):
    fields = PARTS["fields"].replace('"weight", &Toy::weight', '"limit", &Toy::limit')
    done = compiler(toy({**PARTS, "fields": fields}))
    assert done.returncode != 0
    assert "must list every member of the struct once" in done.stderr, done.stderr


def test_a_map_that_does_not_say_what_its_alpha_does_is_refused(compiler):
    fields = PARTS["fields"].replace("MapAlpha::counts, ", "")
    done = compiler(toy({**PARTS, "fields": fields}))
    assert done.returncode != 0
    assert "MapAlpha" in done.stderr, done.stderr


def test_more_textures_than_a_variant_can_count_are_refused(compiler):
    def many(count):
        names = [f"map_{i}" for i in range(count)]
        fields = "".join(f'Field{{"{n}", &Toy::{n}, MapAlpha::ignored, "Image."}}, ' for n in names)
        members = {n: f"MapSource {n};" for n in names} | {"flag": MEMBERS["flag"]}
        fields += 'Field{"flag", &Toy::flag, "bool."}'
        parts = without(PARTS, "user_code") | {
            "fields": f"static constexpr auto fields = std::tuple{{{fields}}};",
            "alpha": "float alpha() const { return 1.0F; }",
            "constants": "std::array<glm::vec4, 0> constants(const glm::vec3&) const { return {}; }",
        }
        return compiler(toy(parts, members), "-DWHOLE")

    done = many(32)
    assert done.returncode == 0, done.stderr
    done = many(33)
    assert done.returncode != 0
    assert "at most 32 fields that are textures" in done.stderr, done.stderr


def test_a_kind_with_a_wrong_type_is_refused(compiler):
    done = compiler(toy({**PARTS, "alpha": "int alpha() const { return 1; }"}))
    assert done.returncode != 0
    assert "float alpha() const" in done.stderr, done.stderr
