"""A live view in the output of a notebook's cell: the canvas, its panel, and a PNG for readers without a kernel."""

from __future__ import annotations

import functools
import weakref
from typing import TYPE_CHECKING, Any

from .canvases import needs

if TYPE_CHECKING:
    from .live import LiveView

__all__ = ["display_view", "notebook_canvas", "notebook_widget"]

_widgets: weakref.WeakKeyDictionary[LiveView, Any] = weakref.WeakKeyDictionary()
_displayed: weakref.WeakKeyDictionary[LiveView, object] = weakref.WeakKeyDictionary()


def notebook_canvas(view: LiveView) -> Any:
    """Make a canvas for notebooks (anywidget): JupyterLab, Notebook, VS Code, Marimo."""
    needs("anywidget", "jupyter")
    canvas = _canvas_class()(size=view.size, title="", max_fps=30)
    view._attach(canvas)
    return canvas


@functools.cache
def _canvas_class() -> Any:
    """Give rendercanvas' canvas for notebooks, whose closing ends."""
    base: Any = needs("rendercanvas.anywidget", "jupyter").RenderCanvas

    class NotebookCanvas(base):  # type: ignore[misc]
        def _rc_close(self) -> None:
            # rendercanvas 2.7 sends itself the message that the canvas was closed, and answers it by closing again.
            if not self.get_closed():
                self._is_closed = True
                super()._rc_close()

    return NotebookCanvas


def notebook_widget(view: LiveView) -> Any:
    """Give the widget of a view, one for each view: the canvas above its line of text, and the panel beside both."""
    known = _widgets.get(view)
    if known is not None:
        return known
    widgets = needs("ipywidgets", "jupyter")
    canvas = notebook_canvas(view)
    line = widgets.HTML(value="&nbsp;")
    picture = widgets.VBox([canvas, line])
    sections = view.panel()
    parts: list[Any] = [picture]
    if sections:
        from .widgets import panel_widgets

        panel = panel_widgets(view)
        panel.box.layout.max_height = f"{view.size[1] + 30}px"
        panel.box.layout.width = "330px"
        panel.box.layout.overflow = "auto"
        parts.append(panel.box)
    box = widgets.HBox(parts)

    def heard(name: str, value: Any) -> None:
        if name == "text":
            import html

            line.value = html.escape(str(value)) or "&nbsp;"
        elif name == "closed":
            from .widgets import close_widget

            close_widget(box)

    view.add_listener(heard)
    _widgets[view] = box
    return box


def display_view(view: LiveView) -> None:
    """Display a view once in a cell: `scene.show()` shows it, and as the last line of a cell not a second time."""
    display = needs("IPython.display", "jupyter").display
    if view.closed:
        display({"text/plain": repr(view)}, raw=True)
        return
    from IPython import get_ipython

    shell = get_ipython()
    cell = None if shell is None else shell.execution_count
    if cell is not None and _displayed.get(view) == cell:
        return
    _displayed[view] = cell
    display(bundle(view), raw=True)


def bundle(view: LiveView) -> dict[str, Any]:
    """Make what a notebook's file keeps: the live widget, a PNG of the first picture, and one line of text."""
    from ..io import oiio

    png = oiio.encode(".png", view.draw()[..., :3], {})
    made = notebook_widget(view)._repr_mimebundle_()
    data: dict[str, Any] = dict(made[0] if isinstance(made, tuple) else made)
    import base64

    data["image/png"] = base64.b64encode(png).decode()
    data["text/plain"] = repr(view)
    return data
