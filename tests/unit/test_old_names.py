"""The names of 0.1 no longer exist; the error for each one gives its new name in one line."""

import pathlib
import subprocess

import pytest

import cubecam as cc
from cubecam._old_names import OLD_NAMES, OldName, answer_old_names

ROOT = pathlib.Path(__file__).parents[2]

MAKE = {
    "Renderer": lambda: cc.Renderer.__new__(cc.Renderer),
    "Node": lambda: cc.Scene().add(),
    "GlassMaterial": cc.GlassMaterial,
    "MirrorMaterial": cc.MirrorMaterial,
}
#: Old attributes that another name has replaced.
ATTRIBUTES = [
    (owner, old, new)
    for owner, names in OLD_NAMES.items()
    for old, new in names.items()
    if "." not in owner and not isinstance(vars(getattr(cc, owner)).get(old), property)
]


def test_the_table_names_what_there_was():
    assert {(owner, old) for owner, old, _ in ATTRIBUTES} >= {
        ("Renderer", "update"),
        ("Renderer", "cubemap"),
        ("Renderer", "texture"),
        ("Node", "in_probes"),
        ("Node", "casts_shadows"),
        ("Node", "receives_shadows"),
    }


@pytest.mark.parametrize(("owner", "old", "new"), ATTRIBUTES)
def test_attributes(owner, old, new):
    thing = MAKE[owner]()
    answer = rf"^{owner}\.{old} is now {owner}\.{new}$"
    for call in (
        lambda: getattr(thing, old),
        lambda: setattr(thing, old, True),
        lambda: getattr(type(thing), old),
    ):
        with pytest.raises(AttributeError, match=answer):
            call()
    assert not hasattr(thing, old)
    assert old not in dir(thing)
    assert new.partition(",")[0] in dir(thing)


@pytest.mark.parametrize(("old", "new"), OLD_NAMES["Scene.add"].items())
def test_keywords_of_a_method(old, new):
    with pytest.raises(TypeError, match=rf"^add\(\): {old} is now {new}$"):
        cc.Scene().add(**{old: True})  # type: ignore[call-overload]


@pytest.mark.parametrize("owner", ["GlassMaterial", "MirrorMaterial"])
def test_keywords_of_a_class(owner):
    for old, new in OLD_NAMES[owner].items():
        with pytest.raises(TypeError, match=rf"^{owner}\(\): {old} is now {new}$"):
            getattr(cc, owner)(**{old: 0.5})


def test_a_class_below_answers_as_well():
    class Own(cc.Node):
        pass

    with pytest.raises(AttributeError, match=r"^Node\.in_probes is now Node\.in_captures$"):
        Own.__new__(Own).in_probes  # type: ignore[attr-defined]  # noqa: B018
    assert "in_probes" not in dir(Own.__new__(Own))


def test_names_that_never_were_answer_as_python_does():
    with pytest.raises(AttributeError, match="has no attribute 'colour'"):
        cc.Scene().add().colour  # type: ignore[attr-defined]  # noqa: B018


def test_new_names_are_not_covered():
    """An attribute that a class already has is not replaced."""
    before = vars(cc.Node)["in_captures"]
    answer_old_names()
    assert vars(cc.Node)["in_captures"] is before
    assert type(vars(cc.Node)["in_probes"]) is OldName


def test_the_tree_is_free_of_them():
    """Only the table, its tests, the changelog and the decision records contain old names."""
    words = r"in_probes|casts_shadows|receives_shadows|[Rr]enderer\.(update|cubemap|texture)\b"
    allowed = ("CHANGELOG.md", "python/cubecam/_old_names.py", "tests/unit/test_old_names.py")
    # `make docs` copies the changelog into these folders.
    built = [f"--exclude-dir={name}" for name in ("_build", "project", "lessons", "gallery")]
    found = subprocess.run(
        [
            "grep",
            "-rlIE",
            *built,
            words,
            "cpp",
            "shaders",
            "python",
            "tests",
            "docs",
            "notebooks",
            "README.md",
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    ).stdout.split()
    assert [name for name in found if name not in allowed and "adr/" not in name] == []
