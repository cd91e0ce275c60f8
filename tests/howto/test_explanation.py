"""The pages of docs/explanation: what their programs print and show, and the figures in their text."""

import re

import numpy as np
import pytest

import cubecam as cc
from tests.documents import text_of
from tests.howto.pages import printed

pytestmark = pytest.mark.slow


def spoken(capsys, pages, name):
    """The names that a page's programs leave; what they print is what the page shows."""
    capsys.readouterr()
    _, scope = pages(name)
    said = capsys.readouterr().out
    if said:  # another test of this process may have run the page
        assert said.replace("5 % of the face differ\n", "") == printed(name)
    return scope


class TestViews:
    NAME = "docs/explanation/views.md"

    def test_the_views_show_one_world(self, pages, capsys):
        scope = spoken(capsys, pages, self.NAME)
        one, two, six = (scope[name] for name in ("one", "two", "six"))
        assert np.abs(scope["front"] - one.color).max() < 0.01
        left, right = two.color[:, :256], two.color[:, 256:]
        assert (left != right).any()  # two eyes
        assert len({face.tobytes() for face in six.faces}) == 6


class TestKeys:
    NAME = "docs/explanation/keys.md"

    def test_what_is_drawn_is_what_the_page_says(self, pages, capsys):
        scope = spoken(capsys, pages, self.NAME)
        lines = re.findall(r"(\d) drawn, (\d) skipped", printed(self.NAME))
        assert lines == [("6", "0"), ("0", "6"), ("0", "6"), ("1", "5"), ("6", "0")]
        cubes = [cube.faces for cube in scope["cubes"]]
        np.testing.assert_array_equal(cubes[0], cubes[2])
        others = np.arange(6) != cc.Face.NEG_Z
        np.testing.assert_array_equal(cubes[3][others], cubes[2][others])
        # The pixels that differ lie where the ball was and where it is.
        assert 0.02 < scope["changed"].mean() < 0.1


class TestWhatCubemapsGetWrong:
    NAME = "docs/explanation/what_cubemaps_get_wrong.md"

    def test_the_ball_is_wrong_at_its_rim_and_right_in_its_middle(self, pages):
        _, scope = pages(self.NAME)
        apart, on_ball = scope["apart"], scope["on_ball"]
        share = 100 * (apart[on_ball] > 0.1).mean()
        assert abs(share - int(re.findall(r"(\d+) % of the ball", printed(self.NAME))[0])) < 1.5
        assert (apart[~on_ball] > 0.1).mean() < 0.005
        rows, columns = np.nonzero(on_ball)
        middle = np.hypot(rows - rows.mean(), columns - columns.mean()) < 0.2 * np.ptp(rows) / 2
        assert apart[rows[middle], columns[middle]].mean() < 0.6 * apart[on_ball].mean()

    def test_the_true_ball_agrees_with_rays_in_numpy(self, pages):
        _, scope = pages(self.NAME)
        scene, camera, truth, ball = (scope[name] for name in ("scene", "camera", "truth", "ball"))
        with cc.Renderer() as renderer:
            seen = renderer.render(
                scene, camera, (360, 360), format="rgba32f", outputs=("id", "position", "normal")
            )
        on_ball = seen.id == ball.id
        p, n = seen.position[on_ball].astype(float), seen.normal[on_ball].astype(float)
        i = p - camera.position
        i /= np.linalg.norm(i, axis=-1, keepdims=True)
        r = i - 2 * (n * i).sum(axis=-1, keepdims=True) * n
        q = p + r * ((2 * np.sign(r) - p) / r).min(axis=-1, keepdims=True)
        dark = np.floor(q * 0.999).sum(axis=-1) % 2 < 0.5
        want = np.where(dark[:, None], 0.02, 0.35 + 0.17 * q)
        close = np.abs(seen.color[on_ball][:, :3] - want).max(axis=-1) < 0.02
        assert close.mean() > 0.98
        assert truth.color.shape == seen.color.shape

    def test_the_figures_of_the_table(self):
        text = text_of(self.NAME)
        assert np.degrees(np.arcsin(np.sin(np.radians(75)) / 55.4)) < 1
        assert "below one degree from about 55 radii" in text
        assert round(np.degrees(np.arctan(1 / 3))) == 18
        assert "18 degrees" in text
        assert abs(3**-1.5 - 1 / 5) < 0.01  # solid angles at a corner and in the middle
        assert "a fifth of the solid angle" in text
        assert 11 < np.degrees(np.arcsin(1 / 5)) < 12
        assert "at most 12 degrees" in text
        lesson = text_of("notebooks/08-what-cubemaps-get-wrong.ipynb")
        assert "0.080 with one for all, 0.036 with one for each" in lesson
        assert "6% of the pixels of the teapot should show a part of the teapot" in lesson
