"""docs/howto/servers_and_docker.md: its program, its packages, its messages."""

import re

import pytest
from click.testing import CliRunner

import cubecam as cc
from cubecam.cli import app
from cubecam.doctor.mesa import check_mesa
from cubecam.doctor.packages import _DISTRIBUTIONS
from cubecam.doctor.report import as_lines
from tests.documents import ROOT, fenced, text_of
from tests.fake_system import DEBIAN, NOT_DRAWN, FakeSystem, write
from tests.howto.pages import printed

NAME = "docs/howto/servers_and_docker.md"


@pytest.mark.slow
def test_the_program_draws_a_ball(pages, capsys):
    folder, scope = pages(NAME)
    picture = cc.load_image(folder / "ball.png")
    assert picture.shape[:2] == (240, 320)
    middle, corner = picture[120, 160, :3].astype(int), picture[5, 5, :3].astype(int)
    assert middle[0] > middle[2]  # gold
    assert abs(middle - corner).max() > 20
    assert scope["renderer"].info.renderer


@pytest.mark.llvmpipe("the page shows the lines of a machine without a GPU")
def test_info_prints_what_the_page_shows():
    said = CliRunner().invoke(app, ["info", "--device", "software"]).output
    want = re.escape(printed(NAME).strip()).replace(r"\.\.\.", ".*")
    assert re.match(want, said, re.DOTALL), said


def test_every_command_of_cubecam_exists():
    lines = "\n".join(fenced(NAME, "sh"))
    for line in re.findall(r"^cubecam ([\w-]+)(?: --(\w+))?", lines, re.MULTILINE):
        command = app.commands[line[0]]
        assert not line[1] or f"--{line[1]}" in {o for p in command.params for o in p.opts}


def test_doctor_prints_what_the_page_shows(tmp_path):
    """On a Debian in a folder, as root, with Mesa's EGL and without its drivers."""
    library = "/usr/lib/x86_64-linux-gnu/libEGL_mesa.so.0"
    write(tmp_path, {"/etc/os-release": DEBIAN, library: ""})
    system = FakeSystem(root=tmp_path, uid=0)
    said = "\n".join(as_lines(check_mesa(system, NOT_DRAWN)))
    assert said.strip() == fenced(NAME, "console")[0].strip()


def test_the_packages_are_those_that_doctor_names():
    text = text_of(NAME)
    for known in _DISTRIBUTIONS:
        if "alpine" in known.names:
            continue
        assert known.mesa in text
        assert not known.nvidia or known.nvidia.format(branch="535") in text


def test_the_images_install_what_the_page_says():
    (own,) = fenced(NAME, "dockerfile")
    packages = "libegl1 libegl-mesa0 libgl1-mesa-dri"
    ours = text_of("Dockerfile")
    for text in (own, ours):
        assert packages in text
        assert re.search(r"NVIDIA_DRIVER_CAPABILITIES=\S*graphics", text)
        assert "XDG_CACHE_HOME=/tmp/cache" in text
        assert re.search(r"^USER 1000", text, re.MULTILINE)
    for line in re.findall(
        r"^docker run --rm cubecam.*$|^docker build .*?cubecam \.", text_of(NAME), re.MULTILINE
    ):
        assert line.split(" --selftest")[0] in ours
    assert re.search(r"^image:", text_of("Makefile"), re.MULTILINE)


def test_the_messages_are_those_of_the_sources():
    sources = "\n".join(
        path.read_text(encoding="utf-8") for path in (ROOT / "cpp/cubecam/gl").glob("*.[ch]pp")
    )
    sources = re.sub(r'"\s*\n\s*"', "", sources)
    for words in ("cannot be loaded", "Mesa's software driver is missing", "no permission on ",
                  "the driver offers OpenGL ", "4.5 is needed"):  # fmt: skip
        assert words in text_of(NAME)
        assert words in sources
