"""What the tools of drives export: which of their columns is which signal, in which unit. One TOML file each.

A file has the `source` of what it states and, for each signal, the `names` of its columns, the likeliest first, with
their `unit` (where the export itself says none) and `scale`, and a `note` on what these take for granted, which is said
wherever they are used. A name stands for itself and for the end of a longer one: `vel_estimate` for
`odrv0.axis0.vel_estimate`. One that ends with a hyphen is the beginning: `velocity-` of `velocity-left-drive`. Adding a
tool is a file and a line in `PROFILES`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cache
from importlib.resources import files

import msgspec

from rwn.errors import InputError, unrecognised
from rwn.recording.signals import TIME

PROFILES = ("odrive", "moteus", "dynamixel", "twincat", "sinamics", "sysid")


class ProfileColumn(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """The names under which a tool exports a signal; `scale` [`scale_unit`] as in a column map; `note`: see above."""

    names: tuple[str, ...]
    unit: str | None = None
    scale: float = 1.0
    scale_unit: str = ""
    note: str = ""


class Profile(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """`columns`: signal -> its names and unit; `source`: where that is said."""

    source: str
    columns: dict[str, ProfileColumn]


class Wanted(frozenset[str]):
    """Names that are wanted whole, or as a part of a longer one as profiles have them, in letters of either case."""

    ends: frozenset[str]

    @classmethod
    def of(cls, names: Iterable[str], ends: Iterable[str]) -> Wanted:
        """Whole `names`, and `ends`."""
        ends = frozenset(ends)
        made = cls({*names, *ends})
        made.ends = frozenset(end.lower() for end in ends)
        return made

    def __contains__(self, name: object) -> bool:
        return super().__contains__(name) or (isinstance(name, str) and any(_ends(name, end) for end in self.ends))


def profile(name: str, *, where: object = "profile") -> Profile:
    """The profile of that name. Raises InputError where there is none."""
    if name not in PROFILES:
        raise unrecognised("profile", name, PROFILES, where=where)
    return _read(name)


def known_profile(name: str | None, *, where: object) -> str | None:
    """The name as it is, where there is such a profile or none is meant. Raises InputError."""
    if name is not None:
        profile(name, where=where)
    return name


@cache
def _read(name: str) -> Profile:
    text = files("rwn.recording.profiles").joinpath(f"{name}.toml").read_text(encoding="utf-8")
    return msgspec.convert(tomllib.loads(text), Profile)


def names_of(known: Profile) -> Iterator[str]:
    """Every name of every signal."""
    for column in known.columns.values():
        yield from column.names


def sources(known: Profile, names: Collection[str], *, where: object) -> Mapping[str, str]:
    """The column of each signal that a table with columns `names` has. Raises InputError where two could be meant."""
    found: dict[str, str] = {}
    for signal, column in known.columns.items():
        for wanted in column.names:
            meant = [name for name in names if _ends(name, wanted.lower())]
            if len(meant) > 1:
                raise InputError(
                    f"{' and '.join(meant[:4])} may both be the {signal}",
                    where=where,
                    expected="one of them",
                    fix=f"add to [recording]: rename = {{ '{meant[0]}' = '{signal}' }}",
                )
            if meant:
                found[signal] = meant[0]
                break
    return found


def exporters(names: Collection[str]) -> list[str]:
    """The profiles that know two signals or more by such names, those of most signals first."""
    found = {name: _signals_of(profile(name), names) - {TIME.name} for name in PROFILES}
    return sorted((name for name, of in found.items() if len(of) > 1), key=lambda name: -len(found[name]))


def _signals_of(known: Profile, names: Collection[str]) -> set[str]:
    """The signals that a profile knows by some of `names`."""
    return {
        signal
        for signal, column in known.columns.items()
        if any(_ends(name, wanted.lower()) for name in names for wanted in column.names)
    }


def _ends(name: str, end: str) -> bool:
    plain = name.lower()
    return plain == end or (plain.startswith(end) if end.endswith("-") else plain.endswith(f".{end}"))
