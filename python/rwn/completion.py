"""What the shell offers after a word of the command line; imported and called only when Tab is pressed."""

from __future__ import annotations

from collections.abc import Iterable


def effect_names(incomplete: str) -> list[str]:
    """The effects that begin so."""
    from rwn.model import vocabulary

    return _beginning(incomplete, vocabulary.table())


def profiles(incomplete: str) -> list[str]:
    """The tools that begin so."""
    from rwn.recording.profiles import PROFILES

    return _beginning(incomplete, PROFILES)


def machines(incomplete: str) -> list[str]:
    """The real machines that begin so."""
    from rwn.studies.machines.registry import MACHINES

    return _beginning(incomplete, MACHINES)


def _beginning(incomplete: str, names: Iterable[str]) -> list[str]:
    return [name for name in names if name.startswith(incomplete)]
