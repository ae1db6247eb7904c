"""Every public callable has a signature, and every public name documentation."""

import enum
import inspect

import pytest

import calligraphy as cal

MODULE = {name: value for name, value in vars(cal._calligraphy).items() if not name.startswith("_")}
CLASSES = {name: value for name, value in MODULE.items() if isinstance(value, type)}
FUNCTIONS = {name: value for name, value in MODULE.items() if callable(value) and name not in CLASSES}


def members(kind):
    """The public members that a class defines itself, by name, and its constructor."""
    return {name: getattr(kind, name) for name in vars(kind) if not name.startswith("_") or name == "__init__"}


CALLABLES = FUNCTIONS | CLASSES
for _name, _kind in CLASSES.items():
    if not issubclass(_kind, enum.Enum):
        CALLABLES |= {f"{_name}.{name}": value for name, value in members(_kind).items() if callable(value)}


@pytest.mark.parametrize("name", CALLABLES)
def test_every_public_callable_has_a_signature(name):
    told = inspect.signature(CALLABLES[name])
    words = [each.name for each in told.parameters.values()]
    assert len(set(words)) == len(words) and not any(word.startswith("arg") for word in words if word != "args")


def test_signatures_have_the_names_defaults_and_kinds_of_the_arguments():
    assert str(inspect.signature(cal.nearest_point)) == (
        "(control_points, queries, method='exact', tolerance=1e-09, samples=16, refinements=2)"
    )
    assert str(inspect.signature(cal.ink_outline)) == "(stroke, tolerance=0.0005)"
    assert str(inspect.signature(cal.lay_out)) == "(characters, layout=Ellipsis)"
    assert str(inspect.signature(cal.device_profiles)) == "()"
    assert str(inspect.signature(cal.Recording)) == "(rate, samples, page=0, law='', inputs=[], setup=None)"
    assert str(inspect.signature(cal.write_page)) == "(page, options, progress=None, store=None)"
    assert str(inspect.signature(cal.write_with_device)) == "(page, device, options=Ellipsis, watch=None, store=None)"
    servo = "device, law, *, rate=0.0, timeout=0.004, ramp_down=0.01, ramp_up=0.2"
    assert str(inspect.signature(cal.Servo)) == f"({servo})"
    assert str(inspect.signature(cal.Servo.__init__)) == f"(self, {servo})"
    assert str(inspect.signature(cal.StrokeElement.point)) == "(self, t)"
    assert str(inspect.signature(cal.StrokeElement([[0, 0], [1, 1]]).point)) == "(t)"
    assert str(inspect.signature(cal.RendererOptions.for_device)) == "(capabilities, scale=1.0)"
    assert str(inspect.signature(cal.StylusState)) == (
        "(*, pressure=nan, force=nan, altitude=nan, azimuth=nan, twist=nan, height=nan)"
    )
    assert str(inspect.signature(cal.InvalidValue)) == "(*args)"
    assert str(inspect.signature(cal.CharacterSet)) == "(*args, **kwargs)", "its constructor is overloaded"
    assert str(inspect.signature(cal.VelocityEstimator)) == "(cutoff=50.0)"
    assert str(inspect.signature(cal.HapticDevice.__exit__)) == "(self, *args)"


@pytest.mark.parametrize("kind", [kind for kind in CLASSES.values() if hasattr(kind, "fields")])
def test_the_signature_of_a_struct_shows_its_fields_and_their_defaults(kind):
    parameters = inspect.signature(kind).parameters
    assert tuple(parameters) == kind.fields
    for name, parameter in parameters.items():
        assert parameter.kind == inspect.Parameter.KEYWORD_ONLY
        if parameter.default is not ...:
            assert kind(**{name: parameter.default}) == kind()


def test_a_subclass_has_the_signature_of_its_own_constructor():
    class Pen(cal.HapticDevice):
        def __init__(self, port, *, rate=1000):
            super().__init__()

    assert str(inspect.signature(Pen)) == "(port, *, rate=1000)"
    assert str(inspect.signature(type("Same", (cal.HapticDevice,), {}))) == "()"


def test_every_public_name_is_documented():
    silent = [name for name, value in (CLASSES | FUNCTIONS).items() if not documentation(value)]
    for name, kind in CLASSES.items():
        if not issubclass(kind, enum.Enum):
            told = {each: value for each, value in members(kind).items() if each not in ("__init__", "fields")}
            silent += [f"{name}.{each}" for each, value in told.items() if not documentation(value)]
    assert silent == []


def documentation(value):
    """Without the line that has the types."""
    text = value.__doc__ or ""
    return text.partition("\n\n")[2] if callable(value) and text.startswith(f"{value.__name__}(") else text


def test_the_types_of_arguments_precede_the_documentation():
    assert cal.typical_stroke.__doc__.startswith("typical_stroke(id: ")
    assert "-> calligraphy._calligraphy.TypicalStroke\n\n" in cal.typical_stroke.__doc__
