"""The scripts that check packages find what is wrong, and recipes for packages agree with pyproject.toml."""

import json
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.helpers import load_script, need_no_sanitizer

if sys.version_info >= (3, 11):
    import tomllib
else:
    from pip._vendor import tomli as tomllib

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())


@pytest.fixture
def scripts(monkeypatch):
    """Load scripts as when they are started: they import each other by their names."""
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    return load_script


def compiled(folder, source, *options):
    need_no_sanitizer("the compiler does not start with its library")
    (folder / "a.c").write_text(source)
    compiler = shutil.which("cc") or shutil.which("gcc")
    assert compiler is not None, "expected a C compiler: make sets one up"
    library = folder / "a.so"
    command = [compiler, "-shared", "-fPIC", *options, folder / "a.c", "-o", library]
    subprocess.run(command, check=True)
    return library


def test_symbols_of_python_are_those_of_this_python(scripts, tmp_path):
    """A name that no Python has is found; names that are no part of Python are not looked for."""
    check_wheel = scripts("check_wheel")
    source = "void Py_IncRef(void *); void Py_NoSuch(void *); void other(void *);\n"
    calls = "void PyInit__core(void) { Py_IncRef(0); Py_NoSuch(0); other(0); }\n"
    needed, defined = check_wheel.symbols(compiled(tmp_path, source + calls))
    assert {"Py_IncRef", "Py_NoSuch", "other"} <= needed
    assert defined == {"PyInit__core"}
    assert check_wheel.missing_in_python(needed) == ["Py_NoSuch"]


def test_a_wheel_for_an_older_system_has_no_newer_symbols(scripts, tmp_path):
    check_wheel = scripts("check_wheel")
    source = "#include <stdlib.h>\nvoid *f(void) { return malloc(3); }\n"
    found = check_wheel.newest_symbols(compiled(tmp_path, source))
    assert set(found) == {"GLIBC"}
    assert check_wheel.too_new(found, "manylinux_2_28") == []
    newer = {"GLIBC": (2, 34), "GLIBCXX": (3, 4, 24), "CXXABI": (1, 3, 13), "GCC": (3, 0)}
    assert check_wheel.too_new(newer, "manylinux_2_28") == ["GLIBC 2.34", "CXXABI 1.3.13"]


def sbom():
    return json.loads(
        re.sub(r"@(\w+)@", "1.2.3", (ROOT / "cmake" / "sbom.cdx.json.in").read_text())
    )


def wheel_with(folder, change=None, leave_out=()):
    """The notices of a wheel; `change` changes its bill of materials."""
    bill = sbom()
    if change:
        change(bill)
    files = {
        f"cubecam-1.dist-info/licenses/{name}": ""
        for name in ("LICENSE", "python/cubecam/data/CREDITS.md")
    }
    files |= {
        f"cubecam-1.dist-info/licenses/licenses/{name}.txt": ""
        for name in ("glad", "glm", "pybind11")
    }
    files["cubecam-1.dist-info/sboms/cubecam.cdx.json"] = json.dumps(bill)
    path = folder / "cubecam-1-cp312-cp312-linux_x86_64.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("cubecam-1.dist-info/sboms/", "")  # as auditwheel lists folders
        for name, text in files.items():
            if not name.endswith(tuple(leave_out) or ("\0",)):
                archive.writestr(name, text)
    return path


def test_notices_are_complete(scripts, tmp_path):
    check_wheel = scripts("check_wheel")
    with zipfile.ZipFile(wheel_with(tmp_path)) as archive:
        check_wheel.check_notices(archive)
    for missing in ("LICENSE", "CREDITS.md", "glm.txt", "cubecam.cdx.json"):
        with (
            zipfile.ZipFile(wheel_with(tmp_path, leave_out=[missing])) as archive,
            pytest.raises(check_wheel.WheelError, match=re.escape(missing)),
        ):
            check_wheel.check_notices(archive)


@pytest.mark.parametrize(
    "platform", ["linux_{0}", "manylinux_2_27_{0}.manylinux_2_28_{0}", "manylinux2014_{0}"]
)
def test_the_extension_is_for_the_processor_of_the_wheel(scripts, platform):
    check_wheel = scripts("check_wheel")
    for machine, other in (("x86_64", "aarch64"), ("aarch64", "x86_64")):
        wheel = Path(f"cubecam-1-cp312-cp312-{platform.format(machine)}.whl")
        check_wheel.check_name(wheel, f"cubecam/_core.cpython-312-{machine}-linux-gnu.so")
        for wrong in (f"312-{other}", f"311-{machine}"):
            with pytest.raises(check_wheel.WheelError, match=f"cpython-312-{machine}"):
                check_wheel.check_name(wheel, f"cubecam/_core.cpython-{wrong}-linux-gnu.so")


def test_a_wheel_that_is_too_large_is_found(scripts, tmp_path, monkeypatch):
    check_wheel = scripts("check_wheel")
    wheel = wheel_with(tmp_path)
    monkeypatch.setattr(check_wheel, "LARGEST", wheel.stat().st_size)
    with pytest.raises(check_wheel.WheelError, match="expected less than"):
        check_wheel.check(wheel)
    monkeypatch.setattr(check_wheel, "LARGEST", wheel.stat().st_size + 1)
    with pytest.raises(check_wheel.WheelError, match=r"expected cubecam/_core\.pyi"):
        check_wheel.check(wheel)


def test_a_bill_of_materials_without_a_version_is_found(scripts, tmp_path):
    check_wheel = scripts("check_wheel")

    def forget(bill):
        bill["components"][1]["version"] = ""

    with (
        zipfile.ZipFile(wheel_with(tmp_path, forget)) as archive,
        pytest.raises(check_wheel.WheelError, match="expected versions"),
    ):
        check_wheel.check_notices(archive)


def test_a_bill_of_materials_is_valid_by_the_schema(scripts):
    """As CycloneDX publishes it, with its lists of licences; that a wrong one is found shows that it was read."""
    pytest.importorskip("cyclonedx.validation.json", reason="with the extra packages")
    check_wheel = scripts("check_wheel")
    if not check_wheel.validate(sbom()):
        pytest.skip("with the extra packages")
    wrong = sbom()
    wrong["components"][0]["licenses"] = [{"license": {"id": "BSD"}}]
    with pytest.raises(check_wheel.WheelError, match=r"not CycloneDX 1\.6"):
        check_wheel.validate(wrong)


def test_the_files_that_state_the_version_agree(scripts):
    assert len(set(scripts("release").versions().values())) == 1


def write_release(
    root, version="1.2.3", changelog="## Unreleased\n\n## 1.2.3 - 2026-01-02\n\n- New.\n"
):
    for folder in ("conda", "python/cubecam"):
        (root / folder).mkdir(parents=True)
    (root / "pyproject.toml").write_text('[project]\nversion = "1.2.3"\n')
    (root / "CITATION.cff").write_text(f"cff-version: 1.2.0\nversion: {version}\n")
    (root / "conda" / "recipe.yaml").write_text('context:\n  version: "1.2.3"\n')
    (root / "python" / "cubecam" / "_core.pyi").write_text('__version__: str = "1.2.3"\n')
    (root / "CHANGELOG.md").write_text("# Changelog\n\n" + changelog)


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({}, None),
        ({"version": "1.2.2"}, "CITATION.cff: expected version 1.2.3"),
        ({"changelog": "## Unreleased\n\n- New.\n"}, 'expected a heading "## 1.2.3 -'),
        ({"changelog": "## Unreleased\n\n## 1.2.3\n\n- New.\n"}, 'expected a heading "## 1.2.3 -'),
        ({"changelog": "## 1.2.3 - 2026-01-02\n\n- New.\n"}, 'expected a heading "## Unreleased"'),
        (
            {"changelog": "## Unreleased\n\n- Newer.\n\n## 1.2.3 - 2026-01-02\n\n- New.\n"},
            "expected nothing under Unreleased, got '- Newer.'",
        ),
        (
            {"changelog": "## Unreleased\n\n## 1.2.3 - 2026-01-02\n\n## 1.2.2\n\n- Old.\n"},
            "expected what is new in 1.2.3",
        ),
    ],
)
def test_a_release_that_is_not_ready_is_found(scripts, tmp_path, change, fault):
    write_release(tmp_path, **change)
    faults = scripts("release").version_faults(tmp_path)
    assert (faults == []) == (fault is None)
    assert fault is None or fault in faults[0]


def test_release_notes_are_the_part_of_the_version(scripts):
    changelog = "# Changelog\n\n## Unreleased\n\n## 1.10.0 - 2026-01-02\n\n### A\n\n- New.\n\n## 1.1.0\n\n- Old.\n"
    notes = scripts("release").notes
    assert notes(changelog, "1.10.0") == "### A\n\n- New."
    assert notes(changelog, "1.1.0") == "- Old."
    assert notes(changelog, "1.0.0") == ""


def test_packages_that_a_release_lacks_are_named(scripts):
    release = scripts("release")
    names = {
        f"cubecam-1.2.3-{python}-{python}-manylinux_2_27_{machine}.manylinux_2_28_{machine}.whl"
        for python in release.PYTHONS
        for machine in release.MACHINES
    } | {"cubecam-1.2.3.tar.gz"}
    assert release.missing_packages(names, "1.2.3") == []
    gone = {name for name in names if "cp312" not in name or "x86_64" in name}
    assert release.missing_packages(gone, "1.2.3") == ["cp312 aarch64"]
    assert len(release.missing_packages(names, "1.2.4")) == 11


def test_cibuildwheel_builds_what_a_release_needs(project, scripts):
    """One list of Pythons and one tag, in the settings of cibuildwheel, the classifiers and the scripts."""
    release = scripts("release")
    settings = project["tool"]["cibuildwheel"]
    assert settings["build"].split() == [f"{python}-*" for python in release.PYTHONS]
    for machine in release.MACHINES:
        assert settings[f"manylinux-{machine}-image"] == release.TAG
    assert release.TAG in scripts("check_wheel").NEWEST
    assert any(release.TAG in step for step in settings["linux"]["repair-wheel-command"])
    oldest = re.fullmatch(r">=3\.(\d+)", project["project"]["requires-python"])
    assert oldest is not None
    assert release.PYTHONS[0] == f"cp3{oldest[1]}"


#: conda-forge's names of packages that have others on PyPI.
CONDA = {"mapbox-earcut": "mapbox_earcut", "openimageio": "py-openimageio"}


def conda_names(requirements):
    for requirement in requirements:
        name = re.split("[<>=]", requirement)[0]
        yield f"{CONDA.get(name.lower(), name.lower())} {requirement[len(name) :]}"


def test_the_conda_recipe_needs_what_the_project_needs(project):
    text = (ROOT / "conda" / "recipe.yaml").read_text()
    listed = {
        section: set(re.findall(r"^    - (.+)$", body, re.MULTILINE))
        for section, body in re.findall(r"^  (host|run):\n((?:    - .+\n)+)", text, re.MULTILINE)
    }
    run = set(conda_names(project["project"]["dependencies"]))
    assert listed["run"] == run | {"python"}
    build = set(conda_names(project["build-system"]["requires"]))
    assert listed["host"] == build | {"glm", "pip", "python"}
    (command,) = project["project"]["scripts"].items()
    assert "    - " + " = ".join(command) + "\n" in text
    for file in ("LICENSE", *(f"licenses/{path.name}" for path in (ROOT / "licenses").iterdir())):
        assert f"    - {file}\n" in text


def test_the_conda_recipe_is_one_for_rattler_build(scripts):
    """It is read and filled in for each Python, without a network."""
    pytest.importorskip("rattler_build", reason="with the extra conda")
    conda = scripts("conda")
    assert [f"cp{python.replace('.', '')}" for python in conda.PYTHONS] == list(
        scripts("release").PYTHONS
    )
    for system in conda.SYSTEMS:
        for variant, python in zip(
            conda.render(system, list(conda.PYTHONS)), conda.PYTHONS, strict=True
        ):
            recipe = variant.recipe.to_dict()
            assert recipe["build"]["string"].startswith(f"py{python.replace('.', '')}h")
            assert f"gxx_{system}" in recipe["requirements"]["build"]


def test_a_source_distribution_inside_another_repository_has_no_files_of_git(
    scripts, tmp_path, monkeypatch
):
    if shutil.which("git") is None:
        pytest.skip("without git")
    sdist, inner = scripts("sdist"), tmp_path / "cubecam-1"
    inner.mkdir()
    subprocess.run(["git", "init", "--quiet", tmp_path], check=True)
    monkeypatch.setattr(sdist, "ROOT", inner)
    assert sdist.tracked_files() is None
    monkeypatch.setattr(sdist, "ROOT", tmp_path)
    assert sdist.tracked_files() == set()


def test_the_image_gets_what_a_wheel_is_made_of(project):
    """.dockerignore lets in the files that the build reads, and no module of the machine's own."""
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    allowed = {line[1:] for line in lines if line.startswith("!")}
    licences = {path.partition("/")[0] for path in project["project"]["license-files"]}
    providers = [one["provider"] for one in project["tool"]["dynamic-metadata"]]
    assert allowed == licences | {f"{one['path']}/{one['module']}.py" for one in providers} | {
        "CMakeLists.txt", "README.md", "pyproject.toml", "cmake", "cpp", "docs/conventions.md", "shaders",
    }  # fmt: skip
    assert {"*", "**/*.so", "python/cubecam/_shader_trial"} <= set(lines)


def test_the_image_can_read_what_a_wheel_says(tmp_path):
    """The metadata are made from the files alone that .dockerignore lets in."""
    pytest.importorskip("scikit_build_core")  # an environment without the tools that build
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    for name in (line[1:] for line in lines if line.startswith("!")):
        source, target = ROOT / name, tmp_path / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
        else:
            shutil.copy(source, target)
    program = "from scikit_build_core.build import prepare_metadata_for_build_wheel as p; p('made')"
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True)
    (found,) = tmp_path.glob("made/*.dist-info/METADATA")
    assert "Name: cubecam" in found.read_text(encoding="utf-8")


def test_the_image_is_not_root_and_has_egl():
    text = (ROOT / "Dockerfile").read_text()
    final = text.split("\nFROM ")[-1]
    assert re.search(r"^USER 1000:1000$", final, re.MULTILINE)
    assert {"libegl1", "libgl1-mesa-dri"} <= set(final.split())
    assert text.count("\nFROM ${BASE}") == 2
