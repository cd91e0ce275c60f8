"""matplotlib is imported by the first picture, and its absence is explained."""

from tests.helpers import run_python


def test_plot_is_there_without_an_import_of_its_own_and_loads_no_matplotlib():
    run_python(
        """
        import sys
        import cubecam as cc
        assert "plot" in cc.__all__ and "plot" in dir(cc)
        assert "cross" in dir(cc.plot)
        assert cc.plot.seam_steps([[[0.0]]] * 6).shape == (12, 1)
        assert "matplotlib" not in sys.modules
        """
    )


def test_without_matplotlib_one_line_says_what_to_install():
    run_python(
        """
        import sys
        sys.modules["matplotlib"] = None  # what an import finds where there is none
        import numpy as np
        import cubecam as cc
        cube = cc.CubeMap(np.zeros((6, 4, 4, 3), np.uint8))
        calls = {
            "cross": (cube,), "faces": (cube,), "panorama": (cube,), "error_map": (cube, cube),
            "vectors": (cube.faces / 1.0,), "arrows": ([0, 0, 0], {"n": [0, 0, 1]}), "seams": (cube,),
            "face_axes": (), "layout": (), "pictures": ([cube.faces[0]],),
        }
        assert set(calls) | {"EDGE_NAMES", "seam_ratios", "seam_steps", "inner_steps"} == set(cc.plot.__all__)
        for name, arguments in calls.items():
            try:
                getattr(cc.plot, name)(*arguments)
            except ImportError as error:
                assert str(error) == (
                    "cc.plot needs matplotlib, which is not installed: pip install cubecam[plot]"
                ), error
            else:
                raise AssertionError(name)
        """
    )


def test_pictures_are_drawn_without_a_warning_and_without_show():
    run_python(
        """
        import matplotlib
        matplotlib.use("agg")
        from matplotlib import pyplot as plt
        plt.switch_backend("agg")
        plt.show = None  # a call would fail
        import numpy as np
        import cubecam as cc
        cube = cc.CubeMap(np.random.default_rng(0).random((6, 8, 8, 3)))
        axes = [
            cc.plot.cross(cube, arrows=True), cc.plot.faces(cube)[0], cc.plot.panorama(cube),
            cc.plot.error_map(cube, cube.resize(4).resize(8)), cc.plot.vectors(cube.faces),
            cc.plot.seams(cube), cc.plot.face_axes(), cc.plot.layout(cube),
            cc.plot.pictures([cube.faces[0]], ["+X"])[0],
            cc.plot.arrows([0, 0, 0], {"n": [0, 0, 1]}, sphere=1),
        ]
        for ax in axes:
            ax.figure.canvas.draw()
        assert len(plt.get_fignums()) == len(axes)
        """
    )
