"""Formulas as MathML, which browsers draw themselves; MathJax would be megabytes of scripts, or a server of others."""

from __future__ import annotations

import html
import re
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError, latex2mathml
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number

logger = logging.getLogger(__name__)

#: Sizes of brackets, which MathML chooses itself.
_SIZES = re.compile(r"\\[bB]igg?[lrm]?(?![a-zA-Z])")

#: Fractions of two digits without braces, which docutils reads as one number.
_DIGITS = re.compile(r"(\\[td]?frac)(\d)(\d)")


def formula(node: nodes.Element, *, block: bool) -> str:
    """Turn a formula of LaTeX into MathML; one that cannot be turned is a warning, and stays as it is."""
    tex = _DIGITS.sub(r"\1{\2}{\3}", _SIZES.sub("", node.astext()))
    try:
        return str(latex2mathml.tex2mathml(tex, as_block=block))
    except MathError as error:
        logger.warning("formula %r: %s", tex, error, location=node)
        return f"<code>{html.escape(tex)}</code>"


def visit_inline(self: Any, node: nodes.math) -> None:
    """Write a formula within a line."""
    self.body.append(formula(node, block=False))
    raise nodes.SkipNode


def visit_block(self: Any, node: nodes.math_block) -> None:
    """Write a formula of its own."""
    self.body.append(self.starttag(node, "div", CLASS="math"))
    if node["number"]:
        self.body.append(f'<span class="eqno">({get_node_equation_number(self, node)})</span>')
    self.body.append(formula(node, block=True) + "</div>\n")
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the renderer, which `html_math_renderer` chooses."""
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
