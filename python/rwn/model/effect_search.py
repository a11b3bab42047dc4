"""Effects by a word of their name or meaning, also where it is misspelt."""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping

from rwn.errors import InputError, closest, plain
from rwn.model.vocabulary import Effect

ALIKE = 0.75  # likeness of two words from which one may be the other misspelt


def effects_by_word(text: str, table: Mapping[str, Effect]) -> tuple[Effect, ...]:
    """The effects that hold every word of `text` in name, meaning, equation or site; else the words most like them."""
    wanted = _words(text)
    if not wanted:
        return ()
    held = {e.name: " ".join((*_words(e.name), *_words(e.meaning), e.site, e.mismatch)) for e in table.values()}

    def holding(words: list[str]) -> tuple[Effect, ...]:
        return tuple(e for e in table.values() if all(word in held[e.name] for word in words))

    known = sorted({word for text in held.values() for word in text.split()})
    alike = [difflib.get_close_matches(word, known, n=1, cutoff=ALIKE) for word in wanted]
    return holding(wanted) or (holding([spelt[0] for spelt in alike]) if all(alike) else ())


def nothing_mentions(text: str, table: Mapping[str, Effect]) -> InputError:
    """The error for a search that found nothing, with the name that was probably meant."""
    meant = closest(text, table)
    return InputError(
        f"no effect mentions '{plain(text, longest=40)}'",
        where="rwn effects",
        expected="an effect, or a word of its name, meaning, equation or site",
        fix=f"did you mean '{meant}'?" if meant else "`rwn effects` lists them all; what is none of them is a formula "
        "under [own_effects]",
    )


def _words(text: str) -> list[str]:
    return re.findall(r"[a-z0-9]+", text.lower())
