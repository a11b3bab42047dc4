"""Bad input, said in one line: what is wrong, where, what was expected, how to fix it."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

LONGEST = 500  # characters of one part of a message


class InputError(ValueError):
    """Input that cannot be used. `str()` is one line: `where: what; expected ...; fix: ...`.

    `what` is wrong; `where`: file, table, row or argument; `expected`: what may stand there; `fix`: what to do. Those
    that are empty are left out of the line.
    """

    def __init__(self, what: str, *, where: object = "", expected: str = "", fix: str = "") -> None:
        self.what, self.where, self.expected, self.fix = (plain(text) for text in (what, str(where), expected, fix))
        what = self.what
        head = f"{self.where}: {what}" if self.where else what
        parts = [head, f"expected {expected}" if expected else "", f"fix: {fix}" if fix else ""]
        super().__init__(" ".join("; ".join(part for part in parts if part).split()))


class NoResultError(RuntimeError):
    """A computation that ran and has no result to stand by.

    `status` says how it ended, `advice` what to do about it, `where` in which recording, model or step.
    """

    def __init__(self, status: str, advice: str, *, where: str) -> None:
        self.status, self.advice, self.where = status, advice, plain(where)
        super().__init__(f"{self.where}: {status}: {advice}")


def plain(text: str, *, longest: int = LONGEST) -> str:
    """A text for a terminal: control characters escaped (a file may hold such), cut where it is very long."""
    shown = "".join(c if c.isprintable() or c in "\n\t\r" else repr(c)[1:-1] for c in text[: longest + 1])
    return shown if len(shown) <= longest else shown[:longest] + " .."


def closest(name: str, names: Iterable[str]) -> str | None:
    """The one of `names` that `name` was probably meant to be, or None."""
    plain = {candidate.lower().replace("-", "_"): candidate for candidate in names}
    key = name.lower().replace("-", "_").replace(" ", "_")
    found = difflib.get_close_matches(key, plain, n=1, cutoff=0.7)
    return plain[found[0]] if found else None


def unrecognised(kind: str, name: str, names: Iterable[str], *, where: object) -> InputError:
    """The error for a `name` that is none of `names`, with the one that was probably meant."""
    known = list(names)
    words = [candidate for candidate in known if candidate in name.lower().split()]
    meant = closest(name, known) or (words[0] if len(words) == 1 else None)
    return InputError(
        f"unknown {kind} '{name}'",
        where=where,
        expected="one of " + ", ".join(known) if known else f"no {kind} here",
        fix=f"did you mean '{meant}'?" if meant else f"remove or rename '{name}'",
    )
