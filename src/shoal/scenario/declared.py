"""Tables of a scenario that files declare the fields of, as models: `[[targets]]` and `[[disturbances]]` by kind."""

import hashlib
import inspect
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from types import NoneType
from typing import Annotated, Any, Literal, get_args, get_origin, get_type_hints

from pydantic import AfterValidator, Field, create_model, model_validator

from shoal.core.declared import Declared
from shoal.core.errors import PluginError, reason_of
from shoal.core.units import Choice, Doc, FileName, Range, Unit
from shoal.scenario.frozen import Frozen


def models_of(
    found: Iterable[Declared[Any]],
    base_of: Callable[[Any], type[Frozen]],
    wrong: list[PluginError],
    *,
    suffix: str,
    module: str,
    first: Sequence[str],
) -> dict[str, type[Frozen]]:
    """Return a model per kind: what all have in common, the kind, and what its options say.

    Parameters
    ----------
    base_of : the model of what a kind has in common with others
    wrong : gains what is wrong with kinds of packages that no table can be made of
    suffix, module : of the models' names, WaypointTarget, and where they are found by them
    first : kinds in the order in which they are listed; others follow
    """
    models = {}
    for each in found:
        try:
            models[each.value.name] = _model(each, base_of(each.value), suffix, module)
        except Exception as error:
            if each.package is None:
                raise
            problem = f"the options of {each.value.name!r} make no table: {reason_of(error)}"
            wrong.append(PluginError(each.package, problem, "fix or uninstall it"))
    return {name: models[name] for name in dict.fromkeys((*first, *models)) if name in models}


def _model(found: Declared[Any], base: type[Frozen], suffix: str, module: str) -> type[Frozen]:
    kind, options = found.value, found.value.options
    hints = get_type_hints(options, include_extras=True)
    fields: dict[str, Any] = {"kind": (Literal[kind.name], kind.name)}
    fields |= {name: _field(hint, vars(options).get(name, ...)) for name, hint in hints.items()}
    checks: dict[str, Any] = {}
    if kind.check:
        checks["check_options"] = model_validator(mode="after")(_checked_by(kind.check))
    if found.package:
        source = _source_of(options)
        fields["source"] = (Annotated[str, AfterValidator(_insisting_on(source))], _said(source, _SOURCE))
    name = "".join(word.capitalize() for word in kind.name.split("-")) + suffix
    model: type[Frozen] = create_model(
        name, __base__=base, __module__=module, __doc__=options.__doc__, __validators__=checks, **fields
    )
    return model


def _source_of(options: type[Any]) -> str:
    """First 16 hex digits of a hash over the file of a package that declares these options."""
    return hashlib.sha256(Path(inspect.getfile(options)).read_bytes()).hexdigest()[:16]


_SOURCE = "hash of the package that declares it; Shoal fills it in, then insists on it"


def _field(hint: Any, default: Any) -> tuple[Any, Any]:
    """Type and field of an option, in pydantic's words."""
    says = _mark(hint, Doc)
    words = _mark(hint, Choice)
    if words:
        return Literal[words.words], _said(default if default is ... else words.words[default], says and says.sentence)
    if _mark(hint, FileName):
        return Annotated[str, AfterValidator(_path)], Field(
            default, min_length=1, description=says.sentence if says else None
        )
    return _type(hint), _said(default, says and says.sentence)


def _said(default: Any, sentence: str | None) -> Any:
    return Field(default, description=sentence) if sentence else Field(default)


def _type(hint: Any) -> Any:
    """What values an option takes: a number within its range, perhaps with a unit; a text; true or false; or none."""
    marks = getattr(hint, "__metadata__", ())
    plain = get_args(hint)[0] if get_origin(hint) is Annotated else hint
    arms = [each for each in get_args(plain) if each is not NoneType]
    if arms:
        return _type(Annotated[arms[0], *marks] if marks else arms[0]) | None
    limits = _limits(next((mark for mark in marks if isinstance(mark, Range)), None), plain)
    unit = next((mark for mark in marks if isinstance(mark, Unit)), None)
    if plain is int or (plain is float and unit is None):
        return Annotated[plain, Field(strict=True, **limits)]
    if unit is None:
        return plain
    return Annotated[float, unit, Field(**limits)] if limits else Annotated[float, unit]


def _limits(told: Range | None, kind: Any) -> dict[str, Any]:
    """What a number may be, in pydantic's words; quantities have an upper limit of their own."""
    if told is None:
        return {}
    limits = {"gt" if told.open else "ge": _whole(told.least)}
    if kind is int or told.most < Range().most:
        limits["le"] = _whole(told.most)
    return limits


def _whole(number: float) -> float:
    return int(number) if number == int(number) else number


def _path(text: str) -> str:
    if "\0" in text:
        raise ValueError("file holds a NUL, which no path can; name a file")
    return text


def _checked_by(check: Callable[[Any], None]) -> Callable[[Any], Any]:
    def check_options(self: Any) -> Any:
        try:
            check(self)
        except ValueError:
            raise
        except Exception as error:
            name = type(error).__name__
            raise ValueError(f"cannot be checked: {name}: {error}; fix or uninstall the package") from error
        return self

    return check_options


def _insisting_on(source: str) -> Callable[[str], str]:
    def insist(given: str) -> str:
        if given != source:
            raise ValueError("source is another version than the one installed; install that one, or drop `source`")
        return given

    return insist


def _mark(hint: Any, kind: type[Any]) -> Any:
    """The first annotation of a kind on a type hint, or None."""
    return next((mark for mark in getattr(hint, "__metadata__", ()) if isinstance(mark, kind)), None)
