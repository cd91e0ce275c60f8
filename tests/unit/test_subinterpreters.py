"""An import in a subinterpreter raises ImportError; it used to hang."""

from tests.helpers import run_python

#: `run` returns the text of what a code raises in a new interpreter; the module and its functions differ by version.
RUN = """
import sys

def interpreters():
    if sys.version_info >= (3, 13):
        import _interpreters as module
        kinds = ("isolated", "legacy")
        made = [module.create(kind) for kind in kinds]
    elif sys.version_info >= (3, 12):
        import _xxsubinterpreters as module
        made = [module.create(isolated=isolated) for isolated in (True, False)]
    else:
        import _xxsubinterpreters as module
        made = [module.create()]
    return module, made

def run(module, interpreter, code):
    if sys.version_info >= (3, 13):
        problem = module.exec(interpreter, code)
        return "" if problem is None else problem.formatted
    try:
        module.run_string(interpreter, code)
    except Exception as error:
        return str(error)
    return ""
"""


def test_an_import_in_a_subinterpreter_is_refused():
    run_python(
        RUN
        + """
module, made = interpreters()
for interpreter in made:
    assert run(module, interpreter, "import sys") == ""
    assert "doctor" not in run(module, interpreter, "import cubecam")
    for code in ("import cubecam", "import cubecam", "from cubecam import Mesh", "import cubecam._core"):
        text = run(module, interpreter, code)
        assert "ImportError" in text and "subinterpreter" in text, text
    module.destroy(interpreter)
import cubecam  # the main interpreter is none the worse
assert cubecam.Mesh.box(1).positions.shape == (24, 3)
module, made = interpreters()
for interpreter in made:
    text = run(module, interpreter, "import cubecam")
    assert "ImportError" in text and "subinterpreter" in text, text
    module.destroy(interpreter)
assert cubecam.Mesh.box(1).positions.shape == (24, 3)
""",
        timeout=120,
    )
