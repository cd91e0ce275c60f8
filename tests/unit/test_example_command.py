"""`cubecam example`: stills, animations, films by ffmpeg, the list, the sheet, and what is refused."""

import os
import stat
import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import cubecam as cc
from cubecam import examples
from cubecam.cli.sheet import contact_sheet
from tests.helpers import DEVICE

names = pytest.mark.parametrize("name", examples.NAMES)


def example(*arguments, device=DEVICE):
    from cubecam.cli import app

    given = ["example", *[str(a) for a in arguments]]
    return CliRunner().invoke(app, [*given, "--device", device] if device else given)


def frames_of(path):
    with Image.open(path) as picture:
        return getattr(picture, "n_frames", 1)


@pytest.fixture
def ffmpeg(tmp_path, monkeypatch):
    """A command with the name ffmpeg, which stores its input, and fails if the test wants it to."""
    folder = tmp_path / "bin"
    folder.mkdir()
    script = folder / "ffmpeg"
    script.write_text(
        f"#!{sys.executable}\n"
        "import os, sys\n"
        "if os.environ.get('FFMPEG_FAILS') == 'at once': sys.exit('cannot do that')\n"
        "data = sys.stdin.buffer.read()\n"
        "open(os.environ['FFMPEG_SEEN'], 'w').write(' '.join(sys.argv[1:]))\n"
        "open(sys.argv[-1], 'wb').write(data)\n"
        "if os.environ.get('FFMPEG_FAILS'): sys.exit('no such codec')\n"
    )
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv(
        "IMAGEIO_FFMPEG_EXE", str(script)
    )  # preferred where imageio-ffmpeg is installed
    monkeypatch.setenv("FFMPEG_SEEN", str(tmp_path / "arguments"))
    return tmp_path / "arguments"


@names
def test_every_program_draws_a_still_and_an_animation(name, tmp_path):
    still, moving = tmp_path / "still.png", tmp_path / "moving.png"
    result = example(name, "--frames", 1, "--size", 48, "--out", still)
    assert result.exit_code == 0, result.output
    assert frames_of(still) == 1
    assert np.ptp(cc.load_image(still)) > 50
    result = example(name, "--frames", 3, "--size", 32, "--start", 9, "--out", moving, "--fps", 10)
    assert result.exit_code == 0, result.output
    with Image.open(moving) as picture:
        assert picture.n_frames in (1, 2, 3)  # the file stores equal frames in a row as one frame
        width, height = examples.size_of(examples.load(name), examples.load(name).build())
        assert picture.size == (32, 32 * height // width)


@names
def test_modules_say_what_they_are(name):
    module = examples.load(name)
    assert module.PROGRAM[0] == "P"
    assert 10 < len(module.TITLE) < 80
    assert 0 <= module.STILL < module.FRAMES
    assert module.__doc__ is not None
    assert module.__doc__.startswith(f"{module.PROGRAM}: ")
    for words in ("Look for", "Worth trying"):
        assert words in module.__doc__
    assert "document 00" in module.__doc__ or "documents 00" in module.__doc__
    for known in (module.PROGRAM, module.PROGRAM.lower(), name):
        assert examples.load(known) is module


def test_programs_are_in_order():
    numbers = [int(examples.load(name).PROGRAM[1:]) for name in examples.NAMES]
    assert numbers == sorted(set(numbers))


@names
@pytest.mark.parametrize("document", [False, True], ids=["staged", "document"])
def test_a_frame_depends_on_its_number_alone(name, document, renderer, new_renderer):
    """A frame has the same bytes in any order, from a new renderer or from one that has drawn other frames."""
    module = examples.load(name)
    program, other = module.build(document=document), module.build(document=document)
    width, height = examples.size_of(module, program)
    size = (24, 24 * height // width)
    length = examples.length_of(module, program)
    assert 0 <= examples.still_of(module, program) < length
    chosen = (length // 2, 1, length - 1)
    forth = [module.draw(program, renderer, frame, size=size) for frame in chosen]
    fresh = new_renderer()
    back = [module.draw(other, fresh, frame, size=size) for frame in reversed(chosen)]
    for frame, one, two in zip(chosen, forth, reversed(back), strict=True):
        assert one.shape == (size[1], size[0], 4)
        np.testing.assert_array_equal(one, two, err_msg=f"frame {frame}")
    assert any((forth[0] != picture).any() for picture in forth[1:])


def test_options_go_to_the_renderer(renderer):
    module = examples.load("P14")
    picture = module.draw(module.build(), renderer, 0, size=(16, 16), format="rgba32f")
    assert picture.dtype == np.float32


def test_a_still_is_the_frame_it_says(tmp_path, renderer):
    module = examples.load("P12")
    for options, frame in ((("--start", 7), 7), ((), module.STILL)):
        result = example("p12", "--frames", 1, "--size", 40, *options, "-o", tmp_path / "a.png")
        assert result.exit_code == 0, result.output
        assert f"frame {frame}" in result.output
        samples = min(4, renderer.info.limits.max_samples)
        want = module.draw(module.build(), renderer, frame, size=(40, 40), samples=samples)
        got = cc.load_image(tmp_path / "a.png")
        np.testing.assert_array_equal(got, want[..., :3])


def test_the_document_is_drawn_as_it_was_then(tmp_path, renderer):
    """--document draws the document's scene, with one sample a pixel."""
    result = example("P5", "--frames", 1, "--size", 40, "--document", "-o", tmp_path / "a.png")
    assert result.exit_code == 0, result.output
    module = examples.load("P5")
    program = module.build(document=True)
    still = examples.still_of(module, program)
    assert f"frame {still}," in result.output
    want = module.draw(program, renderer, still, size=(40, 40))
    np.testing.assert_array_equal(cc.load_image(tmp_path / "a.png"), want[..., :3])


def named_faces(folder, size=16):
    """Six files of one colour each, and their paths in order."""
    cube = cc.CubeMap(np.broadcast_to(np.eye(6, 3)[:, None, None], (6, size, size, 3)).copy())
    cube.save(folder / "{face}.png", layout="faces")
    return [folder / f"{face}.png" for face in ("px", "nx", "py", "ny", "pz", "nz")]


@pytest.mark.parametrize(
    "shape",
    ["after the name", "before the name", "by a pattern", "one by one", "path", "path first"],
)
def test_images_of_one_s_own(shape, tmp_path, renderer):
    files = named_faces(tmp_path)
    path = tmp_path / "{face}.png"
    given = {
        "after the name": ["P1", "--images", *files],
        "before the name": ["--images", *files, "P1"],
        "by a pattern": ["P1", "--images", *sorted(tmp_path.glob("*.png"))],
        "one by one": ["P1", *[word for file in files for word in ("--images", file)]],
        "path": ["P1", "--images", path],
        "path first": ["--images", path, "textured_cube"],
    }[shape]
    options = ("--frames", 1, "--size", 40, "-o", tmp_path / "out.png")
    result = example(*given, *options)
    assert result.exit_code == 0, result.output
    module = examples.load("P1")
    program = module.build([str(file) for file in files])
    samples = min(4, renderer.info.limits.max_samples)
    want = module.draw(program, renderer, module.STILL, size=(40, 40), samples=samples)
    np.testing.assert_array_equal(cc.load_image(tmp_path / "out.png"), want[..., :3])


def test_one_image_for_p6(tmp_path, renderer):
    cross = np.random.default_rng(1).integers(0, 256, (48, 64, 3), np.uint8)
    cc.save_image(tmp_path / "cm.png", cross)
    out = tmp_path / "out.png"
    result = example("p6", "--image", tmp_path / "cm.png", "--frames", 1, "--size", 64, "-o", out)
    assert result.exit_code == 0, result.output
    module = examples.load("P6")
    program = module.build(cross)
    size = (64, 64 * module.SIZE[1] // module.SIZE[0])
    samples = min(4, renderer.info.limits.max_samples)
    still = examples.still_of(module, program)
    want = module.draw(program, renderer, still, size=size, samples=samples)
    np.testing.assert_array_equal(cc.load_image(out), want[..., :3])


def test_a_script_is_the_walk(tmp_path, renderer):
    """One event a frame; the still shows the end of the script."""
    script = "drag 30 10; w 5"
    result = example("P2", "--script", script, "--size", 32, "-o", tmp_path / "a.webp")
    assert result.exit_code == 0, result.output
    assert "8 frames from 0 on" in result.output  # a drag in two pieces, five steps
    result = example("P2", "--script", script, "--size", 32, "-o", tmp_path / "a.jpg")
    assert "frame 7," in result.output


def test_a_method_is_that_of_the_program(tmp_path, renderer):
    out = tmp_path / "out.png"
    given = ("--method", "box", "--frames", 1, "--size", 64, "-o", out)
    result = example("P16", *given)
    assert result.exit_code == 0, result.output
    module = examples.load("P16")
    samples = min(4, renderer.info.limits.max_samples)
    box, none = (
        module.draw(
            module.build(method=one), renderer, module.STILL, size=(64, 64), samples=samples
        )
        for one in ("box", "none")
    )
    np.testing.assert_array_equal(cc.load_image(out), box[..., :3])
    assert (box != none).any()


def test_an_animation_holds_the_frames_in_order(tmp_path, renderer):
    result = example("P13", "--frames", 3, "--start", 20, "--size", 32, "-o", tmp_path / "a.webp")
    assert result.exit_code == 0, result.output
    module = examples.load("P13")
    program = module.build()
    samples = min(4, renderer.info.limits.max_samples)
    with Image.open(tmp_path / "a.webp") as picture:
        assert picture.n_frames == 3
        for index in range(3):
            picture.seek(index)
            want = module.draw(program, renderer, 20 + index, size=(32, 32), samples=samples)
            np.testing.assert_array_equal(np.asarray(picture.convert("RGB")), want[..., :3])


@pytest.mark.parametrize("ending", ["jpg", "exr", "png", "gif", "webp"])
def test_kinds_of_file(ending, tmp_path):
    path = tmp_path / f"a.{ending}"
    result = example("P1", "--frames", 1, "--size", 16, "-o", path)
    assert result.exit_code == 0, result.output
    if ending == "exr":
        assert cc.load_image(path).dtype == np.float32
    else:
        with Image.open(path) as picture:
            assert picture.size == (16, 16)


def test_an_exr_looks_like_the_png(tmp_path):
    """The programs' numbers are those of a screen; an EXR holds linear numbers."""
    for ending in ("png", "exr"):
        result = example("P4", "--frames", 1, "--size", 48, "-o", tmp_path / f"a.{ending}")
        assert result.exit_code == 0, result.output
    shown = cc.load_image(tmp_path / "a.png").astype(int)
    assert 50 < shown.mean() < 205
    linear = cc.load_image(tmp_path / "a.exr")[..., :3]
    assert abs(cc.to_screen(linear, tonemap=None).astype(int) - shown).max() <= 1


@pytest.mark.parametrize("ending", ["jpg", "exr"])
def test_endings_that_hold_one_picture_get_one(ending, tmp_path):
    result = example("P1", "--size", 16, "-o", tmp_path / f"a.{ending}")
    assert result.exit_code == 0, result.output
    assert f"frame {examples.load('P1').STILL}" in result.output


def test_the_name_is_the_default_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert example("P15", "--frames", 1, "--size", 8).exit_code == 0
    assert [path.name for path in tmp_path.iterdir()] == ["nothing_redrawn.png"]


def test_list_needs_no_device():
    done = subprocess.run(
        [sys.executable, "-m", "cubecam", "example", "--list"],
        env={**os.environ, "CUBECAM_EGL_LIBRARY": "libnone.so"},
        capture_output=True,
        text=True,
        check=True,
    )
    for name in examples.NAMES:
        module = examples.load(name)
        line = next(text for text in done.stdout.splitlines() if f" {name} " in text)
        assert line.split()[0] == module.PROGRAM
        words = line.split()
        assert (words[-1] == "live") == examples.is_live(name)
        assert words[-2 if examples.is_live(name) else -1] == str(module.FRAMES)
        assert module.TITLE.split()[0] in line


def test_the_sheet_shows_all(tmp_path):
    result = example("--list", "--sheet", tmp_path / "sheet.png")
    assert result.exit_code == 0, result.output
    sheet = cc.load_image(tmp_path / "sheet.png")
    rows = -(-len(examples.NAMES) // 4)
    assert sheet.shape == (12 + rows * 242, 12 + 4 * 220, 3)
    for index in range(len(examples.NAMES)):
        top, left = 12 + index // 4 * 242, 12 + index % 4 * 220
        assert np.ptp(sheet[top : top + 208, left : left + 208]) > 50  # the cell shows a picture
        assert sheet[top + 210 : top + 230, left : left + 208].min() < 120  # and its name below


def test_a_sheet_keeps_shapes_and_order():
    wide = np.zeros((10, 20, 4), np.uint8)
    wide[..., 0] = 255
    tall = np.zeros((20, 10, 3), np.uint8)
    sheet = contact_sheet([wide, tall], ["a", "b" * 40], cell=20)
    assert sheet.shape == (12 + 54, 12 + 2 * 32, 3)
    assert (sheet[12 + 5 : 12 + 15, 12:32] == (255, 0, 0)).all()
    assert (sheet[12:16, 12:32] == 250).all()
    assert (sheet[12:32, 44 + 5 : 44 + 15] == 0).all()


def test_all_of_them(tmp_path, monkeypatch):
    monkeypatch.setattr(examples, "NAMES", ("textured_cube", "nothing_redrawn"))
    folder = tmp_path / "deep" / "out"
    result = example("--all", "--out", folder, "--frames", 2, "--start", 9, "--size", 24)
    assert result.exit_code == 0, result.output
    assert sorted(path.name for path in folder.iterdir()) == [
        "nothing_redrawn.png",
        "sheet.png",
        "textured_cube.png",
    ]
    assert frames_of(folder / "nothing_redrawn.png") == 2


def test_mp4_is_piped_to_ffmpeg(ffmpeg, tmp_path, renderer):
    path = tmp_path / "ball.mp4"
    result = example("P14", "--frames", 2, "--size", 17, "--fps", 12, "-o", path)
    assert result.exit_code == 0, result.output
    told = ffmpeg.read_text()
    for words in ("-f rawvideo", "-pix_fmt rgb24", "-s 17x17", "-r 12", "-pix_fmt yuv420p", "pad="):
        assert words in told
    module = examples.load("P14")
    program = module.build()
    samples = min(4, renderer.info.limits.max_samples)
    want = [
        module.draw(program, renderer, k, size=(17, 17), samples=samples)[..., :3] for k in (0, 1)
    ]
    assert path.read_bytes() == b"".join(picture.tobytes() for picture in want)
    assert not list(tmp_path.glob(".*"))  # no temporary file is left


@pytest.mark.parametrize("when", ["at once", "at the end"])
def test_a_failing_ffmpeg_is_told_and_leaves_the_old_file(ffmpeg, tmp_path, monkeypatch, when):
    path = tmp_path / "ball.mp4"
    path.write_bytes(b"old")
    monkeypatch.setenv("FFMPEG_FAILS", when)
    result = example("P14", "--frames", 2, "--size", 256, "-o", path)
    assert result.exit_code == 1
    assert ("cannot do that" if when == "at once" else "no such codec") in result.output
    assert path.read_bytes() == b"old"
    assert not list(tmp_path.glob(".*"))


def test_without_ffmpeg_nothing_is_drawn(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    result = example("P14", "-o", tmp_path / "a.mp4", device="no such device")
    assert result.exit_code == 1
    assert "ffmpeg" in result.output
    assert "no such device" not in result.output
    assert not list(tmp_path.iterdir())


BAD = {
    "unknown name": (["blur"], 2, "P14 dynamic_reflection"),
    "unknown number": (["P99"], 2, "P99"),
    "no name": ([], 2, "NAME"),
    "name and list": (["P1", "--list"], 2, "only one"),
    "list and all": (["--all", "--list"], 2, "only one"),
    "sheet alone": (["P1", "--sheet", "a.png"], 2, "--list"),
    "frames 0": (["P1", "--frames", "0"], 2, "frames"),
    "start -1": (["P1", "--start", "-1"], 2, "start"),
    "size 0": (["P1", "--size", "0"], 2, "size"),
    "fps 0": (["P1", "--fps", "0"], 2, "fps"),
    "fps 101": (["P1", "--fps", "101"], 2, "fps"),
    "fps nan": (["P1", "--fps", "nan"], 2, "fps"),
    "still ending": (["P1", "--frames", "2", "-o", "a.jpg"], 2, ".gif"),
    "unknown ending": (["P1", "-o", "a.xyz"], 1, ".xyz"),
    "no folder": (["P1", "--frames", "1", "-o", "nowhere/a.png"], 1, "nowhere"),
    "device": (["P1", "--device", "no such card"], 1, "no such card"),
    "five images": (["P1", "--images", *"abcde"], 2, "six files, or one path with {face}, got 5"),
    "images not there": (["P1", "--images", "none/{face}.png"], 1, "none/{face}.png"),
    "images without a name": (["--all", "--images", *"abcdef"], 2, "--images"),
    "images for P7": (["P7", "--images", *"abcdef"], 2, "P1 textured_cube, P2"),
    "image for P1": (["P1", "--image", "a.png"], 2, "P6 model_space_reflection"),
    "image not there": (["P6", "--image", "none.png"], 1, "none.png"),
    "script for P7": (["P7", "--script", "w"], 2, "P2 inside_the_box, P3 skybox"),
    "method for P14": (["P14", "--method", "box"], 2, "P16 shared_cubemap"),
    "unknown method": (["P16", "--method", "ray"], 2, "'none', 'box', 'sphere'"),
    "script of other words": (["P2", "--script", "run 3"], 1, "drag 30 10"),
}


@pytest.mark.parametrize(("arguments", "code", "text"), BAD.values(), ids=BAD)
def test_errors_are_told(arguments, code, text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    given = [*arguments, "--size", "8"] if "--size" not in arguments else arguments
    result = example(*given, device=None if "--device" in arguments else DEVICE)
    assert result.exit_code == code, result.output
    assert text in result.output
    assert "Traceback" not in result.output
    assert not list(tmp_path.iterdir())


def test_loading_says_what_there_is():
    with pytest.raises(ValueError, match=r"P1 textured_cube.*got 'p0'"):
        examples.load("p0")
    with pytest.raises(TypeError, match="name: expected str, got 14"):
        examples.load(14)  # type: ignore[arg-type]
