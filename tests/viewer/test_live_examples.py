"""The live forms of the programs: mouse, keys and animation against the documents' formulas in numpy."""

import base64
import inspect
import io
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from cubecam import examples
from tests.helpers import DEVICE
from tests.programs.oracle import predicted, rx, ry, scaled

ROOT = Path(__file__).parents[2]
LESSONS = (
    "P1",
    "P2",
    "P3",
    "P4",
    "P5",
    "P6",
    "P7",
    "P10",
    "P11",
    "P12",
    "P13",
    "P14",
    "P15",
    "P16",
    "P17",
    "P18",
)
PROGRAMS = LESSONS
#: The programs whose camera stands in the scene, with the view before any drag.
VISITORS = {
    "P2": (0, 0, 1),
    "P3": (0, 0, 1),
    "P13": (0, -1, -5),
    "P14": (0, -1, -5),
    "P15": (0, -1, -5),
    "P16": (0, -0.9, -3.2),
    "P17": (0, -1, -5),
}
ORBITS = ("P4", "P5", "P6", "P7", "P10", "P11", "P12", "P18")
#: Frames a second.
RATES = {
    "P4": 25,
    "P5": 25,
    "P6": 25,
    "P7": 25,
    "P10": 25,
    "P11": 25,
    "P12": 25,
    "P13": 60,
    "P14": 25,
    "P15": 25,
    "P16": 25,
    "P17": 25,
    "P18": 25,
}
#: Options of `draw` without which a picture has words that the live form does not have in its picture.
PLAIN: dict[str, dict[str, Any]] = {
    "P15": {"counter": False},
    "P16": {"labels": False},
}
#: The parameters that make a program's textures small.
SMALL = {"probe_size": 64}


def example(name) -> Any:
    """A module, with the members that only some have."""
    return examples.load(name)


class Driver:
    """A live form on an offscreen canvas, and the hands of its user."""

    def __init__(self, name, renderer, size=None, **live):
        from rendercanvas.offscreen import OffscreenRenderCanvas

        self.module = example(name)
        known = inspect.signature(self.module.live).parameters
        self.options: dict[str, Any] = {k: v for k, v in SMALL.items() if k in known}
        self.view: Any = self.module.live(renderer=renderer, **self.options, **live)
        self.size = self.view.size if size is None else size
        self.canvas = OffscreenRenderCanvas(size=self.size)
        self.view._attach(self.canvas)

    def send(self, **event):
        self.canvas.submit_event(event)
        self.canvas._process_events()

    def drag(self, dx, dy):
        """Press the left button in the middle, move in two steps, and let go."""
        x, y = self.size[0] / 2, self.size[1] / 2
        pointer = {"button": 1, "modifiers": (), "ntouches": 0, "touches": {}}
        self.send(event_type="pointer_down", x=x, y=y, buttons=(1,), **pointer)
        for part in (0.25, 1.0):
            place = {"x": x + part * dx, "y": y + part * dy}
            self.send(event_type="pointer_move", **place, buttons=(1,), **pointer)
        self.send(event_type="pointer_up", x=x + dx, y=y + dy, buttons=(), **pointer)

    def press(self, key):
        for kind in ("key_down", "key_up"):
            self.send(event_type=kind, key=key, modifiers=())

    def at(self, seconds):
        """Move everything to where it is so many seconds after the animation began."""
        assert self.view._animation is not None
        self.view._animation(seconds)

    def example(self, frame, program=None, **options):
        """What `draw` of the module gives in the place of the live picture."""
        program = program or self.module.build(**self.options)
        width, height = self.size
        size = (width, 2 * height) if self.module.PROGRAM == "P16" else (width, height)
        more = PLAIN.get(self.module.PROGRAM, {})
        picture = self.module.draw(program, self.view.renderer, frame, size=size, samples=4, **more)
        return picture[:height]


@pytest.fixture
def drive(renderer):
    """A function that makes drivers; their views are closed at the end."""
    made = []

    def make(name, size=None, **live):
        made.append(Driver(name, renderer, size, **live))
        return made[-1]

    yield make
    for driver in made:
        driver.view.close()


def nearly_equal(got, want):
    """Whether two pictures have the same pixels, except for a few on edges, which rounding moves."""
    assert got.shape == want.shape
    assert np.ptp(want[..., :3]) > 50
    return (got != want).any(axis=-1).mean() < 0.002


def test_the_programs_of_the_issue_are_live():
    live = [examples.load(name).PROGRAM for name in examples.NAMES if examples.is_live(name)]
    assert set(PROGRAMS) <= set(live)


@pytest.mark.parametrize("name", PROGRAMS)
def test_the_first_picture_is_that_of_the_example(drive, name):
    driver = drive(name)
    assert driver.view.title == driver.module.TITLE
    width, height = driver.module.SIZE
    assert driver.view.size == ((width, height // 2) if name == "P16" else (width, height))
    np.testing.assert_array_equal(driver.view.draw(), driver.example(0))


@pytest.mark.parametrize("name", RATES)
def test_the_animation_is_that_of_the_example(drive, name):
    driver = drive(name)
    for frame in (7, 30):
        driver.at(frame / RATES[name])
        assert nearly_equal(driver.view.draw(), driver.example(frame))
    assert not nearly_equal(driver.view.draw(), driver.example(7))


@pytest.mark.parametrize("name", sorted(set(PROGRAMS) - set(RATES)))
def test_what_the_documents_do_not_animate_stands_still(drive, name):
    assert drive(name).view._animation is None


@pytest.mark.parametrize("name", VISITORS)
@pytest.mark.parametrize("size", [(512, 512), (300, 200)], ids=["square", "wide"])
def test_a_drag_turns_the_view_and_w_and_s_walk(drive, name, size):
    driver = drive(name, size, document=True)
    camera = driver.view.camera
    first = np.array(VISITORS[name], float) / np.linalg.norm(VISITORS[name])
    place, angle_x, angle_y = camera.position.copy(), 0.0, 0.0
    for event in ((48, 0), "w", (-10, 30), "s", "s", (25, -80), "w"):
        if isinstance(event, str):
            driver.press(event)
            step = 0.1 if event == "w" else -0.1
            place = place + step * (rx(angle_y) @ ry(angle_x))[:3, :3] @ first
        else:
            driver.drag(*event)
            angle_x += 100 * event[0] / size[1]
            angle_y += 100 * event[1] / size[1]
        view = (rx(angle_y) @ ry(angle_x))[:3, :3] @ first
        gaze = camera.target - camera.position
        np.testing.assert_allclose(gaze / np.linalg.norm(gaze), view, atol=1e-9)
        np.testing.assert_allclose(camera.position, place, atol=1e-9)
    assert abs(angle_x) > 1
    assert abs(angle_y) > 1


@pytest.mark.parametrize("name", ["P2", "P3"])
def test_live_and_scripted_walks_show_the_same(drive, name):
    driver = drive(name)
    driver.drag(128, 0)
    driver.press("w")
    driver.drag(-64, 64)
    script = ((25.0, 0.0), "w", (-12.5, 12.5))
    program = driver.module.build(script=script)
    want = driver.example(len(script), program)
    assert nearly_equal(driver.view.draw(), want)
    assert not nearly_equal(driver.view.draw(), driver.example(1, program))


@pytest.mark.parametrize("name", ["P2", "P3"])
def test_a_script_comes_before_the_hands(drive, name):
    """The live view begins where the script ends, and drags go on from its angles."""
    driver = drive(name, script="drag 128 0; w 3")
    program = driver.module.build(script="drag 128 0; w 3")
    assert nearly_equal(driver.view.draw(), driver.example(len(program.script), program))
    driver.drag(0, 64)
    program = driver.module.build(script="drag 128 0; w 3; drag 0 64")
    assert nearly_equal(driver.view.draw(), driver.example(len(program.script), program))


@pytest.mark.parametrize("name", ["P13", "P14", "P15", "P16", "P17"])
def test_a_script_moves_the_visitor_before_the_hands(drive, name):
    driver = drive(name, script="drag 64 0; w 3")
    options = driver.options
    program = driver.module.build(**options, script="drag 64 0; w 3")
    assert nearly_equal(driver.view.draw(), driver.example(0, program))
    driver.drag(0, 32)
    program = driver.module.build(**options, script="drag 64 0; w 3; drag 0 32")
    assert nearly_equal(driver.view.draw(), driver.example(0, program))
    assert not nearly_equal(driver.view.draw(), driver.example(0))


@pytest.mark.parametrize("name", ["P13", "P14"])
def test_view_angles_are_live(drive, name):
    """The live view begins with the angles, and a drag adds to them."""
    driver = drive(name, angles=(20, -10))
    program = driver.module.build(**driver.options, angles=(20, -10))
    np.testing.assert_array_equal(driver.view.draw(), driver.example(0, program))
    driver.drag(51.2, 25.6)
    program = driver.module.build(**driver.options, angles=(30, -5))
    assert nearly_equal(driver.view.draw(), driver.example(0, program))


@pytest.mark.parametrize("name", PROGRAMS)
def test_the_document_is_live_too(drive, name):
    driver = drive(name, document=True)
    program = driver.module.build(**driver.options, document=True)
    np.testing.assert_array_equal(driver.view.draw(), driver.example(0, program))


@pytest.mark.parametrize(
    "options",
    [{}, {"angles": (30, 30)}, {"angles": (10, 30), "script": "drag 102.4 0", "eye": (0, 0, 7)}],
    ids=["document", "angles", "script"],
)
def test_a_drag_turns_the_cube_of_p1(drive, options):
    driver = drive("P1", document=not options, **options)
    cube = driver.view.scene.nodes[-1]
    for dx, dy, angle_x, angle_y in ((0, 0, 30, 30), (102.4, 0, 50, 30), (0, -256, 50, -20)):
        driver.drag(dx, dy)
        matrix = rx(angle_y) @ ry(angle_x) @ scaled(2)
        np.testing.assert_allclose(cube.world_matrix, matrix, atol=1e-6)
        if dx or dy:  # without a drag it is a click, which tells what is there
            assert driver.view.text == f"angleX {angle_x}°, angleY {angle_y}°"
    np.testing.assert_allclose(driver.view.camera.position, (0, 0, 7))


@pytest.mark.parametrize("name", ORBITS)
def test_a_drag_moves_the_camera_round_where_documents_have_no_mouse(drive, name):
    driver = drive(name)
    camera = driver.view.camera
    start, height = camera.position.copy(), driver.size[1]
    driver.drag(0.1 * height, 0)
    turned = ry(-36)[:3, :3] @ start  # the scene follows the hand to the right
    np.testing.assert_allclose(camera.position, turned, atol=1e-6)
    np.testing.assert_allclose(camera.target, (0, 0, 0), atol=1e-12)
    if name == "P4":  # the camera turns on from there, 4 degrees a frame
        driver.at(10 / 25)
        np.testing.assert_allclose(camera.position, ry(40)[:3, :3] @ turned, atol=1e-6)


@pytest.mark.parametrize("stopped", [False, True])
def test_the_eye_in_model_space_follows_a_drag(drive, stopped):
    driver = drive("P6")
    driver.at(0.4)
    if stopped:
        driver.press(" ")
    driver.drag(40, 20)
    if not stopped:
        driver.at(0.4)
    left = driver.view.scene.nodes[0]
    view = driver.view.camera.view
    want = (np.linalg.inv(view @ left.world_matrix) @ (0, 0, 0, 1))[:3]
    np.testing.assert_allclose(left.material.uniforms["camPosModel"], want, atol=1e-5)
    np.testing.assert_allclose(left.world_matrix[:3, :3], ry(40)[:3, :3], atol=1e-6)


@pytest.mark.parametrize("name", RATES)
def test_the_space_bar_stops_the_animation_and_lets_it_go_on(drive, name):
    driver = drive(name)
    driver.at(12 / RATES[name])
    before = driver.view.draw().copy()
    driver.press(" ")
    assert driver.view._animation is None
    np.testing.assert_array_equal(driver.view.draw(), before)
    driver.press(" ")
    driver.at(0.0)
    np.testing.assert_array_equal(driver.view.draw(), before)
    driver.at(8 / RATES[name])
    assert nearly_equal(driver.view.draw(), driver.example(20))


def test_t_changes_ball_and_teapot(drive):
    driver = drive("P12")
    ball = driver.view.draw().copy()
    driver.press("t")
    pot = driver.module.build(reflector="teapot")
    np.testing.assert_array_equal(driver.view.draw(), driver.example(0, pot))
    driver.press("t")
    np.testing.assert_array_equal(driver.view.draw(), ball)


def test_p_shares_one_probe_or_gives_each_its_own(drive):
    driver = drive("P16")
    driver.at(30 / 25)  # the balls are farthest apart
    width, height = driver.size
    both = driver.module.draw(
        driver.module.build(**driver.options),
        driver.view.renderer,
        30,
        size=(width, 2 * height),
        show="both",
        labels=False,
        samples=4,
    )
    for key, want in ((None, both[:height]), ("p", both[height:]), ("p", both[:height])):
        if key:
            driver.press(key)
        assert nearly_equal(driver.view.draw(), want)
    assert not nearly_equal(both[:height], both[height:])


def test_m_goes_through_the_methods_of_p16(drive):
    driver = drive("P16")
    for method in ("box", "sphere", "distance", "layers", "none"):
        driver.press("m")
        assert driver.view.text == f"parallax: {method}"
        program = driver.module.build(**driver.options, method=method)
        assert nearly_equal(driver.view.draw(), driver.example(0, program))
    program = driver.module.build(**driver.options, method="layers")
    assert not nearly_equal(driver.view.draw(), driver.example(0, program))


def test_a_method_is_live(drive):
    driver = drive("P16", method="distance")
    program = driver.module.build(**driver.options, method="distance")
    np.testing.assert_array_equal(driver.view.draw(), driver.example(0, program))


def test_p15_counts_the_views_of_the_last_picture(drive):
    driver = drive("P15")
    counts = []
    for frame in (0, 1, 2, 10, 11, 12):
        driver.at(frame / 25)
        driver.view._picture((64, 64), True)
        driver.at(frame / 25)
        counts.append(int(driver.view.text.removeprefix("views drawn: ")))
    assert counts[0] > 0
    assert counts[1:3] == [0, 0]
    assert all(2 <= count < 7 for count in counts[3:])
    driver.drag(30, 0)
    driver.view._picture((64, 64), True)
    driver.at(12 / 25)
    assert driver.view.text == "views drawn: 1"


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("P1", {"drag"}),
        ("P2", {"drag", "w s"}),
        ("P4", {"drag", "wheel", "space"}),
        ("P7", {"drag", "space", "b"}),
        ("P12", {"drag", "space", "t"}),
        ("P14", {"drag", "w s", "space"}),
        ("P16", {"drag", "w s", "space", "p", "m"}),
    ],
)
def test_the_help_lists_the_keys(drive, name, keys):
    driver = drive(name)
    for key in keys:
        assert any(line.startswith(key) for line in driver.view.help.splitlines()), key
    driver.press("h")
    assert all(key in driver.view.text for key in keys)


def test_the_help_of_one_view_does_not_change_that_of_another(drive):
    first = drive("P12").view.help
    drive("P16")
    assert drive("P12").view.help == first
    assert "space" not in drive("P2").view.help


def test_an_example_of_another_size_keeps_its_formula(drive):
    """The height of the picture counts, not that of the first one."""
    driver = drive("P2", (640, 200))
    driver.drag(20, 0)
    gaze = driver.view.camera.target - driver.view.camera.position
    np.testing.assert_allclose(gaze, (np.sin(np.radians(10)), 0, np.cos(np.radians(10))), atol=1e-9)


@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_shows_it(name):
    module = example(name).__name__.rpartition(".")[2]
    lessons = [
        json.loads(path.read_text(encoding="utf-8"))
        for path in (ROOT / "notebooks").glob("*.ipynb")
    ]
    sources = ["".join(cell["source"]) for lesson in lessons for cell in lesson["cells"]]
    imported = rf"import {module} as (\w+)"
    names = {module, *(found for source in sources for found in re.findall(imported, source))}
    assert any(f"{one}.live(" in source for one in names for source in sources)


def test_a_lesson_keeps_a_picture(drive):
    from cubecam.viewer.notebook import bundle

    view = drive("P14").view
    data = bundle(view)
    with Image.open(io.BytesIO(base64.b64decode(data["image/png"]))) as kept:
        np.testing.assert_array_equal(np.asarray(kept.convert("RGB")), view.draw()[..., :3])
    assert "application/vnd.jupyter.widget-view+json" in data
    canvases = [shown.canvas for shown in view._canvases]
    view.close()
    assert [canvas.get_closed() for canvas in canvases] == [True, True]  # Driver's and the lesson's


# ----- the command


def run(*arguments):
    from click.testing import CliRunner

    from cubecam.cli import app

    return CliRunner().invoke(app, ["example", *arguments])


@pytest.mark.parametrize(
    ("options", "where", "browser"),
    [
        ((), "page", True),
        (("--page", "--no-browser"), "page", False),
        (("--window",), "window", True),
        (("--terminal",), "terminal", True),
    ],
)
def test_the_command_shows_the_program(monkeypatch, options, where, browser):
    from cubecam.viewer.live import LiveView

    shown = []
    monkeypatch.setattr(
        LiveView, "show", lambda view, where, **more: shown.append((view, where, more))
    )
    result = run("p13", "--live", *options, "--device", DEVICE)
    assert result.exit_code == 0, result.output
    ((view, place, more),) = shown
    assert view.title == examples.load("P13").TITLE
    assert (place, more) == (where, {"browser": browser, "block": True})


def test_the_command_shows_the_documents_own_inputs(monkeypatch, tmp_path):
    from cubecam.viewer.live import LiveView

    shown = []
    monkeypatch.setattr(LiveView, "show", lambda view, where, **more: shown.append(view))
    script = ("--script", "drag 128 0; w 3")
    result = run("P2", "--live", "--document", *script, "--device", DEVICE)
    assert result.exit_code == 0, result.output
    (view,) = shown
    place, direction = predicted([(25.0, 0.0), "w", "w", "w"])
    np.testing.assert_allclose(view.camera.position, place, atol=1e-9)
    np.testing.assert_allclose(view.camera.target - place, direction, atol=1e-9)
    material = view.scene.nodes[0].material
    assert not material.cubemap.mipmaps  # the document's scene


@pytest.mark.parametrize("name", examples.NAMES)
def test_live_takes_the_inputs_of_build(name):
    if examples.is_live(name):
        known = inspect.signature(example(name).live).parameters
        assert {"renderer", "document", *examples.inputs_of(name)} <= set(known)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("P9", "--live"), r"expected a program that is live, one of P1 textured_cube, .*; got P9"),
        (("P2", "--live", "--out", "a.png"), r"--out.*expected without --live"),
        (("P2", "--live", "--frames", "3"), r"--frames.*expected without --live"),
        (("P2", "--page"), r"--page.*expected with --live"),
        (("P2", "--no-browser"), r"--no-browser.*expected with --live"),
        (("--live", "--list"), r"--live.*expected a NAME"),
        (("P2", "--live", "--page", "--window"), r"expected one of --page, --window and --term"),
    ],
)
def test_what_makes_no_sense_is_refused(arguments, message):
    result = run(*arguments)
    assert result.exit_code == 2
    assert re.search(message, " ".join(result.output.split())), result.output


def test_another_script_is_refused():
    result = run("P2", "--live", "--script", "fly 3", "--device", DEVICE)
    assert result.exit_code == 1
    assert "expected parts such as" in result.output


def test_a_missing_package_is_named(monkeypatch):
    from cubecam.viewer.live import LiveView

    def show(*_, **__):
        raise ImportError('pip install "cubecam[viewer]" installs it')

    monkeypatch.setattr(LiveView, "show", show)
    result = run("P1", "--live", "--device", DEVICE)
    assert result.exit_code == 1
    assert "cubecam[viewer]" in result.output
    assert "Traceback" not in result.output
