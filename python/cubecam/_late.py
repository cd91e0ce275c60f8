"""Functions and methods whose modules are loaded at their first use, so that `import cubecam` is quick.

numpy alone takes three times as much CPU time as the core.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterable, Mapping
from typing import Any

__all__ = ["LateFunction", "LateMethod", "late_names"]

_PACKAGE = __name__.rpartition(".")[0]


def late_names(
    functions: Mapping[str, Iterable[str]], modules: Iterable[str]
) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """Make `__getattr__` and `__dir__` of the package (PEP 562).

    Parameters
    ----------
    functions : mapping of str to names
        The names that the package takes from each of its modules.
    modules : iterable of str
        Modules that are attributes of the package as soon as somebody names them.
    """
    package = sys.modules[_PACKAGE]
    places = {name: module for module, names in functions.items() for name in names}
    known = [*places, *modules, *(module for module in functions if "." not in module)]

    def get(name: str) -> Any:
        if name not in known:
            raise AttributeError(
                f"module {_PACKAGE!r} has no attribute {name!r}", name=name, obj=package
            )
        if name not in places:
            return importlib.import_module(f"{_PACKAGE}.{name}")
        thing = getattr(importlib.import_module(f"{_PACKAGE}.{places[name]}"), name)
        setattr(package, name, thing)  # the next look-up does not come here
        return thing

    def listed() -> list[str]:
        return sorted({*vars(package), *known})

    return get, listed


class LateMethod:
    """A method in another module: the function takes the place of this object when the method is first looked up."""

    def __init__(self, module: str, function: str) -> None:
        self._module, self._function = module, function
        self._name = function

    def __set_name__(self, owner: type, name: str) -> None:
        """Remember the name that the method has in its class."""
        self._name = name

    @property
    def __wrapped__(self) -> Any:
        """The function, for `inspect` and for programs that write documentation from a class's `__dict__`."""
        function = getattr(importlib.import_module(f"{_PACKAGE}.{self._module}"), self._function)
        function.__name__ = self._name  # errors and pickles of bound methods give this name
        return function

    def __get__(self, instance: Any, owner: type) -> Any:
        """Load the module, and give what a plain function gives."""
        function = self.__wrapped__
        for kind in owner.__mro__:
            if vars(kind).get(self._name) is self:
                setattr(kind, self._name, function)
        return function.__get__(instance, owner)


class LateFunction(LateMethod):
    """A static method in another module, loaded like a `LateMethod`."""

    def __get__(self, instance: Any, owner: type) -> Any:
        """Load the module, and give the function."""
        function = self.__wrapped__
        for kind in owner.__mro__:
            if vars(kind).get(self._name) is self:
                setattr(kind, self._name, staticmethod(function))
        return function
