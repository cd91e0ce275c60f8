"""The panel as ipywidgets: values go both ways, refused values are explained, and nothing stays when a view closes."""

# A small class stands for a LiveView.
# mypy: disable-error-code="arg-type"

import gc
from typing import Any

import ipywidgets
import numpy as np
import pytest
from ipywidgets.widgets.widget import _instances

import cubecam as cc
from cubecam.viewer.panel import Control, Section, properties
from cubecam.viewer.scene_panel import scene_sections
from cubecam.viewer.widgets import panel_widgets
from tests.helpers import run_python


class View:
    """What the widgets need of a LiveView."""

    def __init__(self, sections):
        self.sections = sections
        self.listeners: list[Any] = []
        self.changes = 0

    def panel(self):
        return self.sections()

    def add_listener(self, function):
        self.listeners.append(function)

    def remove_listener(self, function):
        self.listeners.remove(function)

    def changed(self, moving=True):
        self.changes += 1

    def tell(self, name):
        for function in list(self.listeners):
            function(name, None)


@pytest.fixture
def material():
    return cc.MirrorMaterial(env_weight=0.5)


@pytest.fixture
def view(material):
    controls = properties(material)
    return View(lambda: [Section("mirror", controls)])


@pytest.fixture
def panel(view):
    made = panel_widgets(view)
    yield made
    made.close()


def all_of(widget):
    yield widget
    for child in getattr(widget, "children", ()):
        yield from all_of(child)


def inputs(panel, name):
    """The widgets of a control, by the name of its class in the page."""
    return [one for one in all_of(panel.box) if f"cubecam-{name}" in one._dom_classes]


def problems(panel):
    return [w for w in all_of(panel.box) if isinstance(w, ipywidgets.HTML) and w.value]


def test_each_kind_has_its_widget(panel):
    kinds = {
        "env-weight": ipywidgets.FloatSlider,
        "tint": ipywidgets.ColorPicker,
        "double-sided": ipywidgets.Checkbox,
        "blend": ipywidgets.Dropdown,
    }
    for name, kind in kinds.items():
        [widget] = inputs(panel, name)
        assert type(widget) is kind, name
    [section] = panel.box.children
    assert (type(section), section.titles, section.selected_index) == (
        ipywidgets.Accordion, ("mirror",), 0,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("low", "high", "logarithmic", "kind", "widget"),
    [
        (0, 1, False, "number", ipywidgets.FloatSlider),
        (0.01, 100, True, "number", ipywidgets.FloatLogSlider),
        (None, None, False, "number", ipywidgets.FloatText),
        (1, 6, False, "integer", ipywidgets.IntSlider),
        (None, None, False, "integer", ipywidgets.IntText),
        (None, None, False, "text", ipywidgets.Text),
        (None, None, False, "vector", ipywidgets.FloatText),
        (None, None, False, "button", ipywidgets.Button),
    ],
)
def test_widgets_of_kinds(low, high, logarithmic, kind, widget):
    value: Any = {"text": "a", "vector": [1.0, 2.0, 3.0], "button": None}.get(kind, 1)
    control = Control(
        "it", kind, get=lambda: value, set=lambda v: None, low=low, high=high,
        logarithmic=logarithmic,
    )  # fmt: skip
    made = panel_widgets(View(lambda: [Section("s", (control,))]))
    found = inputs(made, "it")
    assert [type(one) for one in found] == [widget] * (3 if kind == "vector" else 1)
    if kind not in ("button", "vector"):
        assert found[0].value == value
    made.close()


def test_a_folded_section_gets_its_widgets_when_it_is_unfolded(view, material):
    """Hundreds of controls in folded sections would take seconds."""
    controls, other = properties(material), properties(cc.AmbientLight())
    view.sections = lambda: [Section("one", other), Section("two", controls, open=False)]
    before = set(_instances)
    panel = panel_widgets(view)
    folded = panel.box.children[1]
    assert folded.selected_index is None
    assert inputs(panel, "env-weight") == []
    material.env_weight = 0.75
    view.tell("panel")
    assert inputs(panel, "env-weight") == []
    folded.selected_index = 0
    [slider] = inputs(panel, "env-weight")
    assert slider.value == 0.75
    folded.selected_index = None
    folded.selected_index = 0
    assert inputs(panel, "env-weight") == [slider]
    slider.value = 0.25
    assert material.env_weight == 0.25
    material.env_weight = 0.5
    view.tell("panel")
    assert slider.value == 0.5
    assert view.changes == 1
    panel.close()
    assert set(_instances) == before


def test_a_widget_changes_the_object(panel, view, material):
    [slider] = inputs(panel, "env-weight")
    slider.value = 0.75
    assert material.env_weight == 0.75
    assert view.changes == 1
    [picker] = inputs(panel, "tint")
    picker.value = "#ff0000"
    assert material.tint.tolist() == [1, 0, 0, 1]
    [switch] = inputs(panel, "double-sided")
    switch.value = True
    assert material.double_sided
    [words] = inputs(panel, "blend")
    words.value = "additive"
    assert material.blend == "additive"
    assert view.changes == 4


def test_parts_of_a_vector():
    light = cc.PointLight((1, 2, 3))
    controls = properties(light)
    panel = panel_widgets(View(lambda: [Section("light", controls)]))
    inputs(panel, "position")[1].value = 5
    assert light.position.tolist() == [1, 5, 3]
    panel.close()


def test_what_a_program_sets_shows(panel, view, material):
    material.env_weight, material.tint, material.blend = 0.75, (0, 0, 1), "alpha"
    view.tell("panel")
    assert inputs(panel, "env-weight")[0].value == 0.75
    assert inputs(panel, "tint")[0].value == "#0000ff"
    assert inputs(panel, "blend")[0].value == "alpha"
    assert view.changes == 0  # to show a value is no change


def test_a_value_beyond_the_slider_stays(panel, view, material):
    material.env_weight = 40
    view.tell("panel")
    assert inputs(panel, "env-weight")[0].value == inputs(panel, "env-weight")[0].max
    assert material.env_weight == 40


def test_a_value_that_is_no_choice_is_added():
    probe = cc.Probe((0, 0, 0))
    controls = properties(probe)
    view = View(lambda: [Section("probe", controls)])
    panel = panel_widgets(view)
    probe.update = 3
    view.tell("panel")
    assert inputs(panel, "update")[0].value == "3"
    assert probe.update == 3
    panel.close()


def test_a_refused_value_is_explained_and_the_old_one_shown():
    camera = cc.PerspectiveCamera(near=1, far=2)
    controls = properties(camera)
    view = View(lambda: [Section("lens", controls)])
    panel = panel_widgets(view)
    [near] = inputs(panel, "near")
    near.value = 5
    assert near.value == pytest.approx(1)
    assert camera.near == 1
    assert view.changes == 0
    [problem] = problems(panel)
    assert "expected near &lt; far, got near 5, far 2" in problem.value
    assert problem.layout.display is None
    near.value = 1.5
    assert camera.near == 1.5
    assert problems(panel) == []
    panel.close()


@pytest.mark.parametrize(
    ("low", "high", "logarithmic", "today", "rounded", "next_step"),
    [(1, 179, False, 50.3, 50.5, 51), (0.01, 100, True, 0.3, 10 ** (-2 + 74 * 0.02), 0.5)],
)
def test_what_a_browser_rounds_is_no_change(low, high, logarithmic, today, rounded, next_step):
    """A browser moves the knob of a new slider to the nearest step, and reports that value."""
    values = [today]
    control = Control(
        "it", "number", get=lambda: values[-1], set=values.append, low=low, high=high,
        logarithmic=logarithmic,
    )  # fmt: skip
    view = View(lambda: [Section("s", (control,))])
    panel = panel_widgets(view)
    [slider] = inputs(panel, "it")
    slider.value = rounded
    assert values == [today]
    slider.value = next_step
    assert values == [today, next_step]
    slider.value = next_step * 1.0003  # typed: on no step
    assert values[-1] == pytest.approx(next_step * 1.0003)
    assert view.changes == 2
    panel.close()


def test_a_button_resets():
    scene = cc.Scene(environment=cc.CubeMap(np.zeros((6, 2, 2, 3), np.float32)))
    ball = scene.add(cc.Mesh.sphere(1), cc.GlassMaterial(ior=1.5), name="ball")

    class Both(View):
        scene: Any
        camera: Any
        exposure, tonemap, output = 0.0, None, "color"

    view = Both(lambda: scene_sections(view))
    view.scene, view.camera = scene, cc.PerspectiveCamera()
    panel = panel_widgets(view)
    inputs(panel, "ior")[0].value = 2.0
    assert ball.material.ior == 2  # type: ignore[union-attr]
    inputs(panel, "reset")[0].click()
    assert ball.material.ior == 1.5  # type: ignore[union-attr]
    assert inputs(panel, "ior")[0].value == 1.5
    panel.close()


def test_sections_that_appear_are_drawn_and_those_that_a_person_folded_stay_so():
    light, other = cc.AmbientLight(), cc.AmbientLight()
    sections = [Section("one", properties(light))]
    view = View(lambda: list(sections))
    panel = panel_widgets(view)
    panel.box.children[0].selected_index = None
    counts = []
    for _ in range(2):
        sections.append(Section("two", properties(other)))
        view.tell("panel")
        assert [a.titles[0] for a in panel.box.children] == ["one", "two"]
        assert [a.selected_index for a in panel.box.children] == [None, 0]
        sections.pop()
        view.tell("panel")
        counts.append(len(_instances))
    assert counts[0] == counts[1]
    panel.close()


def test_closing_leaves_nothing(material):
    probe = cc.Probe((0, 1, 0))  # has vectors and whole numbers, too
    controls = (*properties(material), *properties(probe))
    view = View(lambda: [Section("all", controls)])
    gc.collect()
    before = set(_instances)
    for close in ("panel", "view"):
        panel = panel_widgets(view)
        assert len(_instances) > len(before) + 20
        assert len(view.listeners) == 1
        slider = inputs(panel, "env-weight")[0]
        panel.close() if close == "panel" else view.tell("closed")
        panel.close()
        panel.refresh()
        assert set(_instances) == before
        assert view.listeners == []
        changes = view.changes
        slider.value = 0.125
        assert view.changes == changes


def test_ipywidgets_is_loaded_late():
    run_python(
        """
        import sys
        import cubecam as cc
        from cubecam.viewer import widgets, panel, scene_panel
        assert "ipywidgets" not in sys.modules
        """
    )
