"""The account as a picture: what acts, how much of the mismatch goes with it, what is left, and where."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape

from rwn.decide.account import ActingEffect
from rwn.report import text as words
from rwn.report.diagnosis_data import DiagnosisData
from rwn.report.proof_sentences import SLIGHT
from rwn.report.sentences import about_shares, shown


def account_picture(found: DiagnosisData) -> str:
    """Bars of equal scale, one for each effect of the leading explanation and one for what is left; empty if none."""
    if found.verdict in ("adequate", "insufficient-excitation") or not (found.account or found.remainder.share):
        return ""
    near = shown(found.account)
    rows = "".join(_rows(found, near))
    where = found.location.description
    place = f'<p class="where"><b>Where.</b> {escape(words.capital(where))}.</p>' if where else ""
    said = " ".join(("Share of the mismatch of the refitted nominal model.", *([about_shares(near)] if near else ())))
    return f'<p class="note">{escape(said)}</p><ul class="account">{rows}</ul>{place}'


def _rows(found: DiagnosisData, near: Sequence[ActingEffect]) -> Iterator[str]:
    for effect in near:
        yield _row("acts" if effect.stated else "doubtful", _name(effect), effect.share, _said(effect))
    left = found.remainder
    if not left.signals or left.share < SLIGHT:
        yield _row("left", "Left over", left.share, "no more than noise has")
    else:
        alone = "" if near else "; no effect that has a name comes near"
        said = f"of the {words.listing(left.signals)}, and it is not noise{alone}"
        yield _row("left", "No name here", left.share, said)


def _name(effect: ActingEffect) -> str:
    return words.capital(words.listing([words.plain_name(n) for n in (effect.name, *effect.rivals)], "or"))


def _said(effect: ActingEffect) -> str:
    said = f"acts with probability {words.likelihood(effect.together)}"
    if not effect.stated:
        return f"{said}: not stated"
    return f"{said}; which of them is open" if effect.rivals else said


def _row(kind: str, name: str, share: float, said: str) -> str:
    width = 100.0 * min(max(share, 0.0), 1.0)
    return (
        f'<li class="{kind}"><span class="name">{escape(name)}</span>'
        f'<span class="track" aria-hidden="true"><span style="width:{width:.1f}%"></span></span>'
        f'<span class="share">{escape(words.percent(min(max(share, 0.0), 1.0)))}</span>'
        f'<span class="said">{escape(said)}</span></li>'
    )
