"""JupyterLab in Chromium: a lesson runs, and a live view turns, walks, picks and has a panel that changes it."""

import base64
import io
import shutil
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import PIL.Image
import pytest
from playwright.sync_api import sync_playwright

import cubecam as cc
from tests.browser.jupyter import ARGUMENTS, CHROMIUM, ROOT, Lab, errors, run_all, write_notebook

pytestmark = [pytest.mark.browser, pytest.mark.slow]

SIZE = (480, 360)
FOV = 50.0
SCENE = """
import cubecam as cc
scene = cc.Scene(environment=cc.load_environment(cc.sample_data("sunset.exr"), size=64))
bunny = cc.load_mesh(cc.sample_data("bunny.obj"))
scene.add(bunny.resized(2), cc.MirrorMaterial(color="orange"), name="bunny")
camera = cc.PerspectiveCamera(position=(0, 0.2, 4), target=(0, 0, 0), fov=50)
"""
NOTEBOOK = (
    SCENE,
    'viewer = cc.Viewer(scene, camera, "first_person", size=(480, 360), samples=1)\nviewer',
)


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        yield browser
        browser.close()


def new_page(chromium: Any) -> Any:
    return chromium.new_page(viewport={"width": 1500, "height": 1000})


def test_lesson_1_runs(chromium, tmp_path):
    shutil.copy(ROOT / "notebooks" / "01-from-scene-to-reflection.ipynb", tmp_path / "lesson.ipynb")
    with Lab(tmp_path) as lab:
        page = new_page(chromium)
        page.goto(lab.url("lesson.ipynb"))
        run_all(page)
        assert errors(page) == []
        assert page.locator(".jp-OutputArea img").count() >= 3
        page.close()


@pytest.fixture(scope="module")
def lab(tmp_path_factory) -> Iterator[Lab]:
    folder = tmp_path_factory.mktemp("lab")
    write_notebook(folder / "view.ipynb", *NOTEBOOK)
    with Lab(folder) as made:
        yield made


@pytest.fixture(scope="module")
def shown(chromium, lab) -> Iterator[Any]:
    """The notebook with a live view that has drawn its first picture."""
    page = new_page(chromium)
    page.goto(lab.url("view.ipynb"))
    run_all(page)
    assert errors(page) == []
    page.locator(".renderview-view").first.scroll_into_view_if_needed()
    settle(page)
    yield page
    page.close()


@pytest.fixture
def page(shown, lab) -> Any:
    """The view as it was in the beginning."""
    lab.ask("[setattr(camera, n, v) for n, v in (('position', (0, .2, 4)), ('target', (0, 0, 0)))]")
    settle(shown)
    return shown


def picture(page):
    """The pixels that the browser shows."""
    encoded = page.evaluate(
        """() => {
            const image = document.querySelector('img.renderview-view');
            const canvas = document.createElement('canvas');
            [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
            canvas.getContext('2d').drawImage(image, 0, 0);
            return canvas.toDataURL('image/png').split(',')[1];
        }"""
    )
    with PIL.Image.open(io.BytesIO(base64.b64decode(encoded))) as image:
        return np.asarray(image.convert("RGB"))


def settle(page):
    """Wait until the picture has its full size and does not change any more."""
    last = None
    for _ in range(60):
        page.wait_for_timeout(300)
        now = picture(page)
        if now.shape[:2] == SIZE[::-1] and last is not None and np.array_equal(now, last):
            return
        last = now
    raise AssertionError("the picture never came to rest")


def expected(camera):
    """What a renderer of this process draws."""
    names: dict[str, Any] = {"cc": cc}
    exec(SCENE, names)
    with cc.Renderer() as renderer:
        frame = renderer.render(names["scene"], camera, SIZE, tonemap="neutral", encode="srgb")
        return frame.color[..., :3].copy()


def middle(page):
    box = page.locator("img.renderview-view").first.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def direction(lab):
    position, target = lab.ask("(camera.position.tolist(), camera.target.tolist())")
    ahead = np.subtract(target, position)
    return np.array(position), ahead / np.linalg.norm(ahead)


def about_y(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def drag(page, dx):
    x, y = middle(page)
    page.mouse.move(x, y)
    page.mouse.down()
    for part in (0.25, 0.5, 0.75, 1):
        page.mouse.move(x + part * dx, y)
    page.mouse.up()
    settle(page)


def test_a_still_picture_is_what_a_renderer_draws(page):
    camera = cc.PerspectiveCamera(position=(0, 0.2, 4), target=(0, 0, 0), fov=FOV)
    assert np.array_equal(picture(page), expected(camera))


def test_a_drag_turns_the_view_to_what_numpy_predicts(page, lab):
    _, before = direction(lab)
    drag(page, 60)
    position, after = direction(lab)
    # The whole height shows FOV degrees; what is under the pointer follows it to the right, so the view turns left.
    degrees = FOV * 60 / SIZE[1]
    want = about_y(degrees) @ before
    assert np.allclose(after, want, atol=1e-6)
    assert np.allclose(position, (0, 0.2, 4))
    camera = cc.PerspectiveCamera(position=position, target=position + want, fov=FOV)
    difference = np.abs(picture(page).astype(int) - expected(camera))
    assert (difference.max(axis=-1) <= 1).mean() > 0.999


def test_w_walks_a_tenth(page, lab):
    start, ahead = direction(lab)
    page.mouse.move(*middle(page))
    page.mouse.click(*middle(page))
    page.keyboard.press("w")
    settle(page)
    position, after = direction(lab)
    assert np.allclose(position - start, 0.1 * ahead, atol=1e-9)
    assert np.allclose(after, ahead, atol=1e-6)


def test_a_click_picks_the_bunny(page, lab):
    page.mouse.click(*middle(page))
    settle(page)
    assert lab.ask("viewer.picked.node.name") == "bunny"
    # The ray through the middle of the picture: the hit lies on it.
    hit = np.array(lab.ask("[float(x) for x in viewer.picked.position]"))
    start, ahead = direction(lab)
    assert np.linalg.norm(np.cross(hit - start, ahead)) < 0.02
    assert page.get_by_text("bunny", exact=False).count() > 0


def test_a_slider_changes_the_material(page, lab):
    before = picture(page)
    weight = lab.ask("scene['bunny'].material.env_weight")
    handle = page.locator(".cubecam-env-weight .noUi-handle").first
    handle.scroll_into_view_if_needed()
    handle.focus()
    for _ in range(10):
        page.keyboard.press("ArrowLeft")
    until = time.monotonic() + 10
    while lab.ask("scene['bunny'].material.env_weight") == weight and time.monotonic() < until:
        page.wait_for_timeout(100)
    settle(page)
    now = lab.ask("scene['bunny'].material.env_weight")
    assert now == pytest.approx(weight - 10 * 0.01, abs=1e-6)  # steps of a slider from 0 to 2
    assert (picture(page) != before).any()
    page.locator("button.cubecam-reset").click()
    settle(page)
    assert lab.ask("scene['bunny'].material.env_weight") == weight
    assert np.array_equal(picture(page), before)


def test_a_panel_shows_what_a_program_sets(page, lab):
    lab.ask("setattr(scene['bunny'].material, 'env_weight', 0.25)")
    readout = page.locator(".cubecam-env-weight .widget-readout", has_text="0.250")
    readout.wait_for(timeout=10_000)
    lab.ask("setattr(scene['bunny'].material, 'env_weight', 1)")
    settle(page)


def test_a_refused_value_is_explained(page, lab):
    far = lab.ask("camera.far")
    lab.ask("setattr(camera, 'near', 20)")
    page.get_by_text("Lens", exact=True).click()
    handle = page.locator(".cubecam-far .noUi-handle").first
    handle.scroll_into_view_if_needed()
    handle.focus()
    page.keyboard.press("Home")  # 10, the least number of the slider
    page.get_by_text("expected near < far").wait_for(timeout=10_000)
    assert lab.ask("camera.far") == far
    lab.ask("setattr(camera, 'near', 0.1)")


def test_closing_leaves_nothing(page, lab):
    widgets = "len(__import__('ipywidgets').widgets.widget._instances)"
    assert lab.ask(widgets) > 50
    lab.ask("viewer.close()")
    page.wait_for_timeout(500)
    assert lab.ask(widgets) == 0
    assert (
        lab.ask("[t.name for t in __import__('threading').enumerate() if 'cubecam' in t.name]")
        == []
    )
