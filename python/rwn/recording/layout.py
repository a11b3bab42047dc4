"""How the files of a bench are laid out, and what else they do not say."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Literal

from rwn.fields import check_fields
from rwn.recording.intersample import AUTO, known_law
from rwn.recording.profiles import Wanted, names_of, profile
from rwn.recording.signals import COLUMNS

Initial = Literal["auto", "rest", "estimate"]


@dataclass(frozen=True, kw_only=True)
class Column:
    """Where a signal comes from: a column or variable `source` and its `unit` (None: from the file's header).

    It is multiplied by `scale` [`scale_unit`]: a gear ratio, -1 for a wrong sign, 35.15 N/V for a force.
    """

    source: str
    unit: str | None = None
    scale: float = 1.0
    scale_unit: str = ""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """The column map (signal -> Column) and what else the files do not say.

    `sample_time` [s]: of files without a time column. `initial`: whether recordings start at rest (no speed,
    no current), from a state that has to be estimated, or as each one's first samples show ("auto"). `initial_samples`:
    from how many samples that is read, and the state of a transfer function estimated on recordings that are not fitted
    (which they do not judge). `intersample`: how the input acted between the rows, by a name in
    `rwn.recording.intersample.INTERSAMPLE`; "auto": as the recordings show where they are fitted, and held where one is
    simulated. `delays` [s]: by which measured signals come late. `filters` [s]: time constants of first-order filters
    that the samples of measured signals went through, before they came late. `start`, `end` [s], in the file's own
    time: rows outside are left out; of the rest every `decimate`-th row is kept. `profile`: the tool that exported the
    files, a name in `rwn.recording.profiles.PROFILES`; it says which of its columns is which signal. `speed_rows`: rows
    before and after its own between whose positions a speed was taken, (0, 0) a speed of its own; None: as its values
    show. Raises InputError where `intersample` or `profile` is no name of these.
    """

    columns: Mapping[str, Column] = field(default_factory=dict)
    sample_time: float | None = None
    initial: Initial = "auto"
    initial_samples: int = 20
    intersample: str = AUTO
    delays: Mapping[str, float] = field(default_factory=dict)
    filters: Mapping[str, float] = field(default_factory=dict)
    start: float | None = None
    end: float | None = None
    decimate: int = 1
    profile: str | None = None
    speed_rows: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        """Refuses what is no law or no profile."""
        check_fields(self, where="Layout")
        known_law(self.intersample, where="Layout, intersample")
        if self.profile is not None:
            profile(self.profile, where="Layout, profile")

    @property
    def wanted(self) -> Collection[str]:
        """The names of columns that may hold a signal."""
        names = {column.source for column in self.columns.values()} | set(COLUMNS)
        return Wanted.of(names, names_of(profile(self.profile))) if self.profile is not None else names
