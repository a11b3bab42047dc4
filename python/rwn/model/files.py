"""Model files: TOML that is read into a model, and models written as TOML."""

from __future__ import annotations

from pathlib import Path

from rwn.errors import InputError
from rwn.input_file import input_file, path_of
from rwn.model.checks import check_one_numbers
from rwn.model.model import Model
from rwn.model.toml_reader import parse_model
from rwn.model.toml_writer import format_model


def read_model(path: str | Path) -> Model:
    """Read the model file at `path`; see docs/models.md.

    Raises InputError: what, in which table and key, what was expected, how to fix it.
    """
    return parse_model(_read_text(path_of(path, "motor.toml")), where=str(path))


def model_of(source: Model | str | Path) -> Model:
    """A model, or the one that a file describes. Raises InputError."""
    if isinstance(source, Model):
        return source
    if isinstance(source, str | Path):
        return read_model(source)
    raise InputError(
        f"a model cannot be read from the {type(source).__name__}",
        where="model",
        expected="a path, or a rwn.Model",
        fix='pass for instance "motor.toml"',
    )


def model_to_fit(source: Model | str | Path) -> Model:
    """The same, of which no two parameters contradict each other. Raises InputError."""
    model = model_of(source)
    check_one_numbers(model.drive, model.parameters, where=model.source or "model")
    return model


def write_model(model: Model, path: str | Path) -> None:
    """Write a model file that `read_model` reads back as an equal model. Raises InputError for a path that is none."""
    path_of(path, "motor.toml").write_text(format_model(model), encoding="utf-8")


def _read_text(path: Path) -> str:
    with input_file(path, "a model file (TOML)"):
        if path.stat().st_size > 2**20:
            raise InputError(
                "the model file is larger than 1 MB",
                where=path,
                expected="a short TOML file",
                fix="was a recording given as --model?",
            )
        try:
            return path.read_text(encoding="utf-8-sig")
        except UnicodeDecodeError as error:
            raise InputError(
                "this is not a text file",
                where=path,
                expected="a model file (TOML, UTF-8)",
                fix="give the model file, not a recording",
            ) from error
