"""The thesis's 85 numbers, one row each: how many are reproduced, by table, and the cause of each that is not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich.table import Table

from rwn.studies.thesis.causes import cause
from rwn.studies.thesis.experiment import Row
from rwn.studies.thesis.formats import number, where_order
from rwn.studies.thesis.runner import Finished
from rwn.studies.thesis.words import WORDS, word

# How many distinct numbers the thesis prints where. The B of Table 19's second case and Morlet's of Table 16 are
# not among them: the one is unreadable, the other not given.
NUMBERS = {
    "Table 1": 6,
    "Table 2": 8,
    "Table 3": 2,
    "Table 4": 3,
    "Table 5": 6,
    "Table 6": 6,
    "Table 7": 2,
    "Table 8": 3,
    "Figure 30": 2,
    "Table 9": 3,
    "Figure 37": 2,
    "Table 10": 3,
    "Figure 46": 1,
    "Figure 49": 1,
    "Figure 51": 1,
    "Figure 54": 1,
    "Table 11": 3,
    "Table 12": 3,
    "Table 13": 3,
    "Table 14": 3,
    "Table 15": 3,
    "Table 16": 2,
    "Table 17": 4,
    "Table 18": 6,
    "Table 19": 5,
    "Table 20": 2,
    "Figure 104": 1,
}


def answers(results: Sequence[Finished]) -> Iterator[tuple[Row, str]]:
    """The rows that speak for a number of the thesis, with their words, in the order of the thesis."""
    found = [(row, word(row, r.rows)) for r in results for row in r.rows if row.answer]
    return iter(sorted(found, key=lambda pair: where_order(pair[0].where)))


def counts(results: Sequence[Finished]) -> dict[str, dict[str, int]]:
    """How many numbers got each word, by table or figure; those that no result holds are missing."""
    found: dict[str, dict[str, int]] = {}
    for row, said in answers(results):
        by_word = found.setdefault(row.where, dict.fromkeys(WORDS, 0))
        by_word[said] += 1
    return found


def totals(results: Sequence[Finished]) -> dict[str, int]:
    """How many numbers got each word."""
    found = counts(results).values()
    return {w: sum(by_word[w] for by_word in found) for w in WORDS}


def overview_markdown(results: Sequence[Finished]) -> str:
    """One line per table or figure that has numbers, and the sum."""
    lines = ["| | numbers | " + " | ".join(WORDS) + " |", "|" + "---|" * (2 + len(WORDS))]
    for where, by_word in counts(results).items():
        cells = " | ".join(str(by_word[w]) if by_word[w] else "" for w in WORDS)
        lines.append(f"| {where} | {sum(by_word.values())} | {cells} |")
    every = totals(results)
    lines.append(f"| all | {sum(every.values())} | " + " | ".join(str(every[w]) for w in WORDS) + " |")
    return "\n".join(lines)


def overview_table(results: Sequence[Finished]) -> Table:
    """The same for the terminal."""
    table = Table("", "numbers", *WORDS, title="The numbers of Zahidi 2013, beside this package")
    for where, by_word in counts(results).items():
        table.add_row(where, str(sum(by_word.values())), *(str(by_word[w] or "") for w in WORDS))
    every = totals(results)
    table.add_row("all", str(sum(every.values())), *(str(every[w]) for w in WORDS), style="bold")
    return table


def numbers_markdown(results: Sequence[Finished]) -> str:
    """Every number in one line; the cause where it is not reproduced."""
    lines = ["| where | case | thesis | ours | smallest .. largest | word | cause |", "|" + "---|" * 7]
    for row, said in answers(results):
        ours = row.missing if row.ours is None else number(row.ours, row.unit)
        spread = "" if row.spread is None else " .. ".join(number(v) for v in row.spread)
        why = "" if said == WORDS[0] else cause(row) or "not known"
        lines.append(
            f"| {row.where} | {row.case} | {number(row.thesis, row.unit)} | {ours} | {spread} | {said} | {why} |"
        )
    return "\n".join(lines)
