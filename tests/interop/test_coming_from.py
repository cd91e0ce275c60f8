"""The programs of docs/howto/from_*.md: what the other library's program gives is what cubecam's gives."""

import numpy as np
import pytest

import cubecam as cc
from tests.documents import fenced, python_blocks, run_block
from tests.interop.directions import DIRECTIONS, sky, sky_cube

pytestmark = [
    pytest.mark.interop,
    pytest.mark.filterwarnings("default"),  # of other libraries
]


@pytest.fixture
def both(tmp_path, monkeypatch):
    """Run the first program of a page in each library; give the names of theirs and of ours."""

    def run(name, needed):
        pytest.importorskip(needed)
        page = f"docs/howto/{name}"
        theirs = run_block(fenced(page, "py")[0], page, tmp_path, monkeypatch)
        return theirs, run_block(python_blocks(page)[0], page, tmp_path, monkeypatch)

    return run


def difference(theirs, ours):
    """How far two 8-bit pictures are apart in the mean."""
    return np.abs(theirs.astype(int) - ours).mean()


def test_three_js_reads_the_faces_of_a_capture(page, tmp_path, monkeypatch):
    name = "docs/howto/from_three_js.md"
    ours = run_block(python_blocks(name)[0], name, tmp_path, monkeypatch)["cube"].faces
    theirs = np.array(page("from_three.html", {"program": fenced(name, "js")[0]})).reshape(
        ours.shape
    )
    same = np.abs(theirs - ours).max(axis=-1) < 1e-6
    assert same.mean() > 0.995  # edges of boxes may fall on another pixel
    assert (np.abs(ours[..., :3] - (0.1, 0.2, 0.3)).max(axis=-1) > 0.1).mean() > 0.02


class TestModerngl:
    def test_a_lookup_gives_the_same_number(self, both):
        theirs, ours = both("from_moderngl.md", "moderngl")
        np.testing.assert_allclose(theirs["theirs"], ours["pixel"], rtol=1e-5)

    def test_a_texture_holds_the_faces_as_they_are(self, both):
        theirs, _ = both("from_moderngl.md", "moderngl")
        for face in range(6):
            read = np.frombuffer(theirs["texture"].read(face), np.float32).reshape(64, 64, 3)
            np.testing.assert_array_equal(read, theirs["faces"][face])

    def test_both_draw_in_turn(self, both):
        theirs, ours = both("from_moderngl.md", "moderngl")
        with cc.Renderer() as renderer:
            for _ in range(3):
                renderer.render(ours["scene"], ours["camera"], (4, 4))
                theirs["target"].clear()
                theirs["ctx"].vertex_array(theirs["program"], []).render(vertices=3)
                again = np.frombuffer(theirs["target"].read(components=4, dtype="f4"), np.float32)
                np.testing.assert_array_equal(again[:3], theirs["theirs"])


class TestPy360convert:
    def test_its_faces_go_where_the_page_says(self, both):
        theirs, _ = both("from_py360convert.md", "py360convert")
        np.testing.assert_array_equal(theirs["cube"].faces, theirs["again"].faces)

    def test_a_smooth_sky_is_the_same(self):
        py360convert = pytest.importorskip("py360convert")
        panorama = sky_cube(128).to_equirect(width=512)
        dice = py360convert.e2c(panorama, 64)
        cube = cc.CubeMap.from_layout(dice, layout="cross", convention="inside")
        ours = cc.CubeMap.from_equirect(panorama, size=64)
        assert np.abs(cube.faces - ours.faces).max() < 0.01
        middle = np.s_[:, 30:34, 30:34]
        assert np.abs(cube.faces[middle] - ours.faces[middle]).max() < 0.002
        assert np.abs(py360convert.c2e(dice, 256, 512) - panorama).max() < 0.05

    def test_a_view_is_the_same(self):
        py360convert = pytest.importorskip("py360convert")
        panorama = sky_cube(128).to_equirect(width=1024)
        wide = 2 * np.degrees(np.arctan(np.tan(np.radians(30)) * 4 / 3))
        theirs = py360convert.e2p(panorama, (wide, 60), 30, 20, (240, 320))
        u, v = np.radians((30, 20))
        towards = (np.sin(u) * np.cos(v), np.sin(v), -np.cos(u) * np.cos(v))
        cube = cc.CubeMap.from_equirect(panorama, size=256)
        ours = cube.to_perspective(60, (320, 240), direction=towards)
        assert np.abs(theirs - ours).max() < 0.01


def test_pyvista_shows_the_same_sky(both):
    theirs, ours = both("from_pyvista.md", "pyvista")
    assert difference(theirs["theirs"], ours["ours"]) < 1


def test_pyvista_lights_a_ball_by_the_panorama(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    sky_cube().save(tmp_path / "vtk.png", layout="equirect", center="+x", exposure=-1, tonemap=None)
    texture = pyvista.Texture(str(tmp_path / "vtk.png"))
    texture.mipmap = texture.interpolate = True
    plotter = pyvista.Plotter(off_screen=True, window_size=(32, 32), lighting=None)
    plotter.set_environment_texture(texture, is_srgb=True)
    plotter.add_mesh(
        pyvista.Sphere(radius=0.5, theta_resolution=64, phi_resolution=64),
        pbr=True,
        metallic=1,
        roughness=0,
        color="white",
    )
    for direction in np.delete(DIRECTIONS, [2, 3], axis=0):  # VTK blurs the poles
        eye = 5 * direction / np.linalg.norm(direction)
        plotter.camera_position = [eye, (0, 0, 0), (0.31, 0.2, 0.93)]
        plotter.camera.view_angle = 2
        plotter.renderer.ResetCameraClippingRange()
        plotter.render()
        shown = plotter.screenshot(None, return_img=True)[15:17, 15:17].mean(axis=(0, 1)) / 255
        assert np.abs(2 * shown**2.2 - sky(direction)).max() < 0.05
    plotter.close()


def test_xarray_names_the_axes(tmp_path, monkeypatch):
    """The block of docs/howto/bulk_data.md, after the one that captures."""
    pytest.importorskip("xarray")
    name = "docs/howto/bulk_data.md"
    scope = run_block(python_blocks(name)[0], name, tmp_path, monkeypatch)
    scope = run_block(fenced(name, "py")[0], name, tmp_path, monkeypatch, scope)
    data, store = scope["data"], scope["store"]
    assert data.color.dims == ("sample", "face", "t", "s", "channel")
    np.testing.assert_array_equal(data.color.sel(face="-Z"), store["color"][:][:, 5])
    assert (
        (scope["nearest"] > 1.4) & (scope["nearest"] < 1.6)
    ).all()  # 2.01 to the middle, less .5
    assert scope["above"].shape == (8, 4)


def test_pygfx_shows_the_same_sky(both):
    pytest.importorskip("wgpu")
    theirs, ours = both("from_pygfx.md", "pygfx")
    assert difference(theirs["theirs"], ours["ours"]) < 1
