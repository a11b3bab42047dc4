"""A diagnosis as its user has it: shown, drawn, tabulated, saved and read back."""

from __future__ import annotations

from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rwn.errors import InputError, plain, unrecognised
from rwn.input_file import input_file, path_of
from rwn.model.files import read_model, write_model
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.exchange import CURVES, MODEL, REPORT, RESULT
from rwn.report.output_files import one_result, output_folder
from rwn.report.page import page, panels, pictures
from rwn.report.plots import drawn
from rwn.report.sentences import sentences, verdict_sentence
from rwn.report.text import estimate, likelihood, parameter_name, plain_name
from rwn.values import table_of_rows

if TYPE_CHECKING:
    import pandas
    import plotly.graph_objects


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Diagnosis(DiagnosisData):
    """The verdict, what it rests on, and the curves that show it; SI units.

    verdict: `missing-physics`, `adequate`, `unexplained`, `insufficient-excitation` or `recording-mistake`.
    equation: that the missing physics belongs to: mechanical, electrical, actuator or sensor.
    effects: those that are stated, each with its probability and its parameters with 95 % intervals.
    set: names that these recordings cannot tell apart; the first is that of the first effect.
    beneath: what is said of the drive once a mistake in its recordings is undone; None where there is none.
    explanation: the one that is stated, with its probability among those that were tried; None where none is.
    alternatives: other explanations with their probabilities, and the experiment that would tell.
    sensor_filters: found in the noise, and fitted as part of how the signals were measured.
    findings: what the check of the recordings found, and what was done about it.
    location: the equation and the regions of speed, angle, .. where the mismatch lies.
    nominal_fit: the refitted nominal model, without any effect.
    heldout: free-run errors of the models on recordings that were not fitted.
    curves: the pictures of the report, as data.
    warnings: a sentence each.
    next_experiment: the recording that would tell most; empty where none is needed.
    adequate_probability: that nothing is missing; None in an older file.
    account: every effect of the leading explanation, stated or not, with what it explains.
    remainder: what the stated effects leave of the error.
    not_tried: effects that were not tried beside those of an explanation, for what a search may cost (`effort`).
    sources: the files that were used. command, seed, version: what made this; elapsed [s]: how long it took.
    stand_in: what stands in the corrected model for what has no name; empty where nothing does.
    added: effects that the corrected model holds beyond those of the model as given.
    corrected: the corrected rwn.Model; None of a diagnosis whose folder has no corrected.toml.

    Equal diagnoses are those that are saved alike; how long they took and the command that made them do not count.
    """

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Diagnosis):
            return NotImplemented
        mine, its = ((d.to_json(), d.curves_json(), d.corrected) for d in (self, other))
        return mine == its

    __hash__ = None  # type: ignore[assignment]  # what it holds has none

    def __repr__(self) -> str:
        names = ", ".join(f"{e.name} ({likelihood(e.probability)})" for e in self.effects)
        return f"<Diagnosis {self.verdict}{f': {names}' if names else ''}>"

    def __str__(self) -> str:
        said = verdict_sentence(self)
        return plain(said, longest=len(said))  # a name of a file may hold control characters

    def _repr_html_(self) -> str:
        first, *others = sentences(self)
        rows = "".join(
            "<tr>" + "".join(f"<td>{escape(str(cell))}</td>" for cell in row.values()) + "</tr>" for row in self.rows()
        )
        table = (
            "<table><tr><th>effect</th><th>probability</th><th>parameter</th><th>value</th></tr>" + rows + "</table>"
        )
        return f"<p><b>{escape(first)}</b> {escape(' '.join(others))}</p>{table if rows else ''}"

    def rows(self) -> list[dict[str, Any]]:
        """One row for each parameter of each effect, in words: effect, probability, parameter, value with interval."""
        return [
            {
                "effect": plain_name(e.name), "probability": likelihood(e.probability),
                "parameter": parameter_name(e.name, name) if name else "", "value": estimate(value) if value else "",
            }
            for e in self.effects
            for name, value in (e.parameters.items() or [("", None)])
        ]  # fmt: skip

    def table(self) -> pandas.DataFrame | list[dict[str, Any]]:
        """Every parameter of every effect in SI, a row each; a list of dictionaries where pandas is not installed.

        Columns: effect, equation, probability, parameter, value, low and high (95 %), unit.
        """
        rows = [
            {
                "effect": e.name, "equation": e.equation, "probability": e.probability, "parameter": name,
                "value": value.value, "low": (value.interval or (None, None))[0],
                "high": (value.interval or (None, None))[1], "unit": value.unit,
            }
            for e in self.effects
            for name, value in e.parameters.items()
        ]  # fmt: skip
        columns = ("effect", "equation", "probability", "parameter", "value", "low", "high", "unit")
        found: pandas.DataFrame | list[dict[str, Any]] = table_of_rows(rows, columns)
        return found

    @property
    def plots(self) -> tuple[str, ...]:
        """What `plot` can draw, in the report's order."""
        return tuple(pictures(self.curves))

    def plot(self, name: str | None = None) -> plotly.graph_objects.Figure:
        """The figure of the report called `name`; `plots` lists the names (a recording, or what is drawn). Default: the
        first.

        Raises InputError where there is no such figure, or plotly is not installed.
        """
        known = pictures(self.curves)
        if not known:
            raise InputError("this diagnosis has no curves", where="plot", expected="curves.json beside diagnosis.json",
                             fix="load the folder that rwn diagnose wrote, or diagnose again")  # fmt: skip
        wanted = next(iter(known)) if name is None else name
        if wanted not in known:
            raise unrecognised("figure", str(wanted), known, where="plot")
        return drawn(panels(self.curves, known[wanted]), wanted)

    def write(self, folder: str | Path) -> None:
        """Write report.html, diagnosis.json, curves.json and corrected.toml into a folder that exists.

        Raises InputError for what is no path.
        """
        folder = path_of(folder, "result")
        (folder / RESULT).write_bytes(self.to_json())
        (folder / CURVES).write_bytes(self.curves_json())
        if self.corrected is not None:
            write_model(self.corrected, folder / MODEL)
        (folder / REPORT).write_text(page(self), encoding="utf-8")

    def save(self, folder: str | Path, *, overwrite: bool = False) -> None:
        """Write the files that `rwn diagnose` writes; `load` reads them back.

        Raises InputError where the folder holds files and `overwrite` is false, or cannot be written.
        """
        with output_folder(path_of(folder, "result"), overwrite=overwrite) as aside:
            self.write(aside)

    @classmethod
    def load(cls, folder: str | Path) -> Diagnosis:
        """The diagnosis that `save` or `rwn diagnose` wrote to a folder, with what is there of curves and model.

        Raises InputError where a file is missing or is no diagnosis, or another result takes its place meanwhile.
        """
        path = path_of(folder, "result")
        with one_result(path):
            return cls._read(path)

    @classmethod
    def _read(cls, folder: Path) -> Diagnosis:
        result, curves = folder / RESULT, None
        if folder.is_dir() and not result.exists():
            raise InputError(
                f"there is no {RESULT} in this folder", where=folder, expected="the folder of a diagnosis",
                fix="name the folder that `rwn diagnose --out` or `Diagnosis.save` wrote",
            )  # fmt: skip
        with input_file(result, "the result of rwn diagnose"):
            text = result.read_bytes()
        if (folder / CURVES).exists():
            with input_file(folder / CURVES, f"{CURVES} as rwn diagnose writes it"):
                curves = (folder / CURVES).read_bytes()
        try:
            found = cls.from_json(text, curves)
        except (ValueError, RecursionError) as error:
            raise InputError(
                f"this is no diagnosis of this version ({error})",
                where=folder,
                expected=f"{RESULT} and {CURVES} as rwn wrote them",
                fix="diagnose again",
            ) from error
        return replace(found, corrected=read_model(folder / MODEL)) if (folder / MODEL).exists() else found
