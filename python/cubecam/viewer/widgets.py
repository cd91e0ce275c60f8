"""The panel of a live view as ipywidgets, for notebooks. ipywidgets is imported when the first panel is drawn."""

from __future__ import annotations

import contextlib
import html
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from .._calls import checked_call
from .control import Control, Section
from .panel import panel_to_json, set_control

if TYPE_CHECKING:
    from .live import LiveView

__all__ = ["PanelWidgets", "close_widget", "panel_widgets"]


@checked_call
def panel_widgets(view: LiveView) -> PanelWidgets:
    """Draw the panel of a live view with ipywidgets.

    The widgets change the objects, and follow what a program changes. What a property refuses is written under its
    widget, which then shows the present value again. The widgets close with the view.

    Parameters
    ----------
    view : LiveView

    Returns
    -------
    PanelWidgets
        Its `box` is an ipywidgets.VBox, with one Accordion for each section. The widgets of a folded section are made
        when someone unfolds it.

    Raises
    ------
    ImportError
        If ipywidgets is not installed.

    Examples
    --------
    ::

        viewer = cc.Viewer(scene)
        panel = panel_widgets(viewer)
        display(panel.box)
    """
    return PanelWidgets(view)


class PanelWidgets:
    """A view's panel as widgets.

    Attributes
    ----------
    box : ipywidgets.VBox
        All sections, to be displayed beside or below the picture.
    """

    def __init__(self, view: LiveView) -> None:
        widgets = _ipywidgets()
        self._view = view
        self._sections: list[Section] = []
        self._shape: object = None
        self._rows: list[list[_Row]] = []
        self._closed = False
        self.box = widgets.VBox([], layout=widgets.Layout(width="100%"))
        self.box.add_class("cubecam-panel")
        self.refresh()
        view.add_listener(self._heard)

    def refresh(self) -> None:
        """Show today's values; draw the widgets again if there are other controls than before."""
        if self._closed:
            return
        self._sections = list(self._view.panel())
        described = panel_to_json(self._sections)
        values = [[control.pop("value") for control in one["controls"]] for one in described]
        if described != self._shape:
            self._shape = described
            self._build()
        for rows, numbers in zip(self._rows, values, strict=True):
            if rows:  # none in a section that was never unfolded
                for row, value in zip(rows, numbers, strict=True):
                    row.show(value)

    def close(self) -> None:
        """Close all widgets and stop listening to the view; closing again does nothing."""
        if self._closed:
            return
        self._closed = True
        with contextlib.suppress(ValueError):
            self._view.remove_listener(self._heard)
        self._close_rows()
        close_widget(self.box)

    def _heard(self, name: str, value: object) -> None:
        if name == "panel":
            self.refresh()
        elif name == "closed":
            self.close()

    def _build(self) -> None:
        widgets = _ipywidgets()
        unfolded = {one.titles[0]: one.selected_index == 0 for one in self.box.children}
        old = list(self.box.children)
        self._close_rows()
        self._rows = [[] for _ in self._sections]
        accordions = []
        for number, section in enumerate(self._sections):
            one = widgets.Accordion([widgets.VBox([])], titles=(section.title,))
            one.observe(lambda change, n=number: self._unfolded(n, change["new"]), "selected_index")
            accordions.append(one)
        self.box.children = accordions
        for one, section in zip(accordions, self._sections, strict=True):
            if unfolded.get(section.title, section.open):
                one.selected_index = 0
        for one in old:
            close_widget(one)

    def _unfolded(self, section: int, selected: int | None) -> None:
        """Make the rows of a section when it is unfolded for the first time.

        A panel can have hundreds of controls, and each takes a dozen widgets.
        """
        if selected is None or self._rows[section]:
            return
        rows = [
            self._row(section, c, control)
            for c, control in enumerate(self._sections[section].controls)
        ]
        self._rows[section] = rows
        [inside] = self.box.children[section].children
        inside.children = [row.box for row in rows]
        for row, control in zip(rows, self._sections[section].controls, strict=True):
            row.show(control.get())

    def _row(self, section: int, index: int, control: Control) -> _Row:
        return _Row(control, lambda value: self._set(section, index, value))

    def _set(self, section: int, index: int, value: object) -> None:
        row = self._rows[section][index]
        try:
            set_control(self._sections, section, index, value)
        except (ValueError, TypeError) as error:
            row.problem(str(error))
            row.show(self._sections[section].controls[index].get())
        else:
            row.problem("")
            self._view.changed()
            self.refresh()

    def _close_rows(self) -> None:
        for rows in self._rows:
            for row in rows:
                row.close()
        for one in self.box.children:
            one.unobserve_all()
            close_widget(one)
        self._rows = []
        self.box.children = []


def _ipywidgets() -> Any:
    from .canvases import needs

    return needs("ipywidgets", "jupyter")


def close_widget(widget: Any) -> None:
    """Close a widget and everything in it, with the models of its layout and its style."""
    for child in getattr(widget, "children", ()):
        close_widget(child)
    for name in ("layout", "style"):
        part = getattr(widget, name, None)
        if part is not None:
            part.close()
    widget.close()


class _Row:
    """One control: a label, what changes its value, and a line for what the property refuses."""

    def __init__(self, control: Control, change: Callable[[Any], object]) -> None:
        widgets = _ipywidgets()
        self._control = control
        self._change = change
        self._quiet = False
        self._inputs: list[Any] = list(_inputs(control))
        if control.kind == "button":
            self._inputs[0].on_click(self._clicked)
        else:
            for one in self._inputs:
                one.observe(self._changed, "value")
        for one in self._inputs:
            one.add_class("cubecam-" + _css_word(control.name))
        label = widgets.Label(
            "" if control.kind == "button" else control.name,
            tooltip=control.help,
            layout=widgets.Layout(width="8.5em", min_width="8.5em"),
        )
        unit = [widgets.Label(control.unit)] if control.unit else []
        self._problem = widgets.HTML("", layout=widgets.Layout(display="none"))
        line = widgets.HBox([label, *self._inputs, *unit], layout=widgets.Layout(width="100%"))
        self.box = widgets.VBox([line, self._problem])

    def show(self, value: Any) -> None:
        """Show a value; the widgets report nothing while it is set."""
        if self._control.kind == "button":
            return
        values = value if self._control.kind == "vector" else [value]
        with self._silent():
            for one, number in zip(self._inputs, values, strict=True):
                if self._control.kind == "choice" and number not in one.options:
                    one.options = (*one.options, number)
                if one.value != number:
                    one.value = number

    def problem(self, text: str) -> None:
        """Write why a value was refused; an empty text removes the line."""
        self._problem.value = (
            f'<span role="alert" style="color: var(--jp-error-color1, #c62828)">{html.escape(text)}</span>'
            if text
            else ""
        )
        self._problem.layout.display = None if text else "none"

    def close(self) -> None:
        """Close the widgets of the row."""
        for one in self._inputs:
            one.unobserve_all()
            if self._control.kind == "button":
                one.on_click(self._clicked, remove=True)
        close_widget(self.box)

    @contextlib.contextmanager
    def _silent(self) -> Iterator[None]:
        before, self._quiet = self._quiet, True
        try:
            yield
        finally:
            self._quiet = before

    def _changed(self, _: object) -> None:
        if self._quiet:
            return
        values = [one.value for one in self._inputs]
        if self._control.kind == "number" and _is_rounding(
            self._inputs[0], self._control.get(), values[0]
        ):
            return
        self._change(values if self._control.kind == "vector" else values[0])

    def _clicked(self, _: object) -> None:
        self._change(None)


def _is_rounding(widget: Any, today: float, reported: float) -> bool:
    """Whether a slider only reports today's value rounded to its step, as browsers do when they draw the slider."""
    step = getattr(widget, "step", None)
    if not hasattr(widget, "readout") or not step:
        return False
    low, now, new = widget.min, today, reported
    if hasattr(widget, "base"):  # the steps of a logarithmic slider multiply
        if min(now, new) <= 0:
            return False
        now, new = math.log10(now), math.log10(new)
    steps = (new - low) / step
    on_a_step = abs(steps - round(steps)) < 1e-4
    return bool(on_a_step and abs(new - now) <= 0.5001 * step)


def _css_word(name: str) -> str:
    """Write a control's name as part of a CSS class: "f0 is None" is "f0-is-none"."""
    return "-".join(name.lower().replace("_", " ").split())


def _inputs(control: Control) -> Iterator[Any]:
    """Make the widgets that change the value of a control."""
    widgets = _ipywidgets()
    kind = control.kind
    ranged = control.low is not None and control.high is not None
    if kind == "flag":
        yield widgets.Checkbox(indent=False, layout=_wide())
    elif kind == "choice":
        yield widgets.Dropdown(options=control.choices, layout=_wide())
    elif kind == "color":
        yield widgets.ColorPicker(layout=_wide())
    elif kind == "vector":
        for _ in control.get():
            yield widgets.FloatText(layout=_wide())
    elif kind == "button":
        yield widgets.Button(description=control.name, tooltip=control.help)
    elif kind == "text":
        yield widgets.Text(continuous_update=False, layout=_wide())
    elif kind == "integer":
        yield _whole(control) if ranged else widgets.IntText(layout=_wide())
    elif ranged:
        yield _slider(control)
    else:
        yield widgets.FloatText(layout=_wide())


def _wide() -> Any:
    """Make the layout of a widget that fills the rest of its row; each widget closes a layout of its own."""
    return _ipywidgets().Layout(width="auto", min_width="0", flex="1 1 0%")


def _whole(control: Control) -> Any:
    widgets = _ipywidgets()
    return widgets.IntSlider(min=int(control.low or 0), max=int(control.high or 0), layout=_wide())


def _slider(control: Control) -> Any:
    widgets = _ipywidgets()
    low, high = control.low or 0.0, control.high or 0.0
    if control.logarithmic:
        ends = math.log10(low), math.log10(high)
        return widgets.FloatLogSlider(
            min=ends[0], max=ends[1], step=(ends[1] - ends[0]) / 200, layout=_wide()
        )
    step = control.step or _nice_step((high - low) / 200)
    return widgets.FloatSlider(min=low, max=high, step=step, readout_format=".3g", layout=_wide())


def _nice_step(value: float) -> float:
    """Give the number of 1, 2, 5, 10, ... that is not above a value, so that sliders show round numbers."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(k * power for k in (5, 2, 1) if k * power <= value * (1 + 1e-9))
