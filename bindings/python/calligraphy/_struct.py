"""Common features of the extension's structs: keyword arguments, comparison, representation, copies and pickling."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from functools import partial
from typing import Any

import numpy as np


def equal(one: Any, other: Any) -> bool:
    """Equality in which NaN equals NaN, and arrays and lists are compared as a whole."""
    if isinstance(one, np.ndarray):
        if one.dtype.names and isinstance(other, np.ndarray) and one.dtype == other.dtype:  # a structured array
            return all(equal(one[name], other[name]) for name in one.dtype.names)
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(equal, one, other))
    return bool(one == other or (one != one and other != other))


def shown(value: Any) -> str:
    """The value as a literal; long ones are abbreviated, with their length."""
    if isinstance(value, np.ndarray):
        return repr(value.tolist()) if value.size <= 16 else f"array{value.shape}"
    if isinstance(value, list):
        more = f", ... {len(value)} in all" if len(value) > 8 else ""
        return f"[{', '.join(map(shown, value[:3] if more else value))}{more}]"
    if isinstance(value, str) and len(value) > 80:
        return f"{value[:40]!r}... {len(value)} characters in all"
    return repr(value)


def brief(value: Any) -> str:
    """The value as one line of at most 80 characters, for messages."""
    try:
        line = " ".join(shown(value).split())
    except Exception:  # of a __repr__
        line = f"<{type(value).__name__} object>"
    return line if len(line) <= 80 else f"{line[:77]}..."


def represented(record: Any, names: Iterable[str]) -> str:
    """A call that makes the record again, from its attributes with these names."""
    return f"{type(record).__name__}({', '.join(f'{n}={shown(getattr(record, n))}' for n in names)})"


class Struct:
    """Methods copied into every class that has `__match_args__`."""

    __match_args__: tuple[str, ...]

    def __eq__(self, other: object) -> Any:
        if type(self) is not type(other):
            return NotImplemented
        return all(equal(getattr(self, name), getattr(other, name)) for name in self.__match_args__)

    def __repr__(self) -> str:
        return represented(self, self.__match_args__)

    def __reduce__(self) -> Any:
        values = {name: getattr(self, name) for name in self.__match_args__}
        return partial(type(self), **{k: v.copy() if isinstance(v, np.ndarray) else v for k, v in values.items()}), ()

    def __copy__(self, memo: object = None) -> Any:
        return self.__reduce__()[0]()  # the C++ constructor copies its arguments

    __deepcopy__ = __copy__


def default(value: Any) -> Any:
    """The value if it is a short literal, otherwise `...`."""
    plain = value.tolist() if isinstance(value, np.ndarray) else value
    parts = plain if isinstance(plain, list) else [plain]
    return plain if len(parts) <= 8 and all(isinstance(part, (float, int, str, type(None))) for part in parts) else ...


def signature(kind: Any) -> inspect.Signature:
    """Of a constructor that takes the fields as keywords."""
    made = kind()
    one = inspect.Parameter
    fields = [one(name, one.KEYWORD_ONLY, default=default(getattr(made, name))) for name in kind.fields]
    return inspect.Signature([one("self", one.POSITIONAL_OR_KEYWORD), *fields])


def finish(kind: Any) -> None:
    """Completes a class of the extension."""
    own, made = dict(vars(kind)), kind.__init__

    def with_keywords(self: Any, *given: Any, **values: Any) -> None:
        if given:
            raise TypeError(f"{type(self).__name__} takes its fields by keyword: {', '.join(self.fields)}")
        made(self)
        for name, value in values.items():
            if name not in self.fields:
                raise TypeError(f"{type(self).__name__} has no field {name!r}; it has {', '.join(self.fields)}")
            setattr(self, name, value)

    if "fields" in own:
        setattr(with_keywords, "__signature__", signature(kind))
        kind.__init__ = with_keywords
        setattr(kind, "__match_args__", kind.fields)
    elif "__init__" in own:  # a record, if the constructor takes the values of properties
        taken = tuple(inspect.signature(kind).parameters)
        if taken and all(isinstance(own.get(name), property) for name in taken):
            setattr(kind, "__match_args__", taken)
    if hasattr(kind, "__match_args__"):
        for name in {"__eq__", "__repr__", "__reduce__", "__copy__", "__deepcopy__"} - ({"__repr__"} & set(own)):
            setattr(kind, name, vars(Struct)[name])
        kind.__hash__ = None
    # Protocols 0 and 1 of pickle bypass __new__, without which the extension aborts.
    kind.__reduce_ex__ = lambda self, protocol: object.__reduce_ex__(self, max(protocol, 2))
