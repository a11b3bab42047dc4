"""What the altered corpus finds is counted and kept, and the deadline holds."""

from __future__ import annotations

import os
import re
import signal
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))  # tools are no part of the package

from tools.trust import fuzz, fuzz_corpus  # noqa: E402
from tools.trust.fuzz_corpus import Tried, altered, fuzzed  # noqa: E402

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="forks a process that has loaded rwn")


@pytest.fixture
def only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., list[Tried]]]:
    """Alters two files for each of these targets alone."""

    def run(*, seconds: float, until: float = float("inf"), **targets: fuzz.Target) -> list[Tried]:
        for target in targets:
            (tmp_path / "corpus" / target).mkdir(parents=True)
            for name in "ab":
                (tmp_path / "corpus" / target / name).write_text(name * 50)
        monkeypatch.setattr(fuzz, "CORPUS", tmp_path / "corpus")
        monkeypatch.setattr(fuzz, "TARGETS", targets)
        fuzz_corpus._corpus.cache_clear()
        return list(fuzzed(list(targets), seconds=seconds, until=until, jobs=2, kept=tmp_path / "kept"))

    yield run
    fuzz_corpus._corpus.cache_clear()


def _cut(data: bytes) -> bool:
    return 0 < len(data) < 20


def _reads(_data: bytes) -> None:
    pass


def _sleeps(_data: bytes) -> None:
    time.sleep(9)


def _raises(data: bytes) -> None:
    assert not _cut(data), "too short"


def _crashes(data: bytes) -> None:
    if _cut(data):
        os.kill(os.getpid(), signal.SIGSEGV)


def _hangs(data: bytes) -> None:
    while _cut(data):
        pass


def _waits(data: bytes) -> None:
    if _cut(data):
        time.sleep(60)


def _as_expected(tried: Tried, words: str) -> bool:
    """Whether the first inputs that are cut short are the findings, with these words and their bytes."""
    expected = [number for number in range(1000) if _cut(altered(tried.target, number))][: fuzz_corpus.MOST]
    kept = [re.match(r"(.*-(\d+)): (.*)", finding) for finding in tried.findings]
    named = [(int(k[2]), words in k[3], Path(k[1]).read_bytes()) for k in kept if k]
    return named == [(number, True, altered(tried.target, number)) for number in expected]


@pytest.mark.slow
def test_findings_are_named_kept_and_passed_over(
    only: Callable[..., list[Tried]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fuzz_corpus, "HANG", 1.5)  # more than a traceback takes, also where lines are traced
    bad = {"raises": _raises, "crashes": _crashes, "hangs": _hangs}
    found = {tried.target: tried for tried in only(seconds=24.0, good=_reads, **bad)}
    assert found.keys() == {"good", *bad}
    assert found["good"].findings == []
    assert found["good"].number > 100
    for target, words in {"raises": "raises", "crashes": "SIGSEGV", "hangs": "over 1.5 s"}.items():
        assert _as_expected(found[target], words)
    assert "too short" in found["raises"].findings[0]
    assert "in _hangs" in found["hangs"].findings[0]


@pytest.mark.slow
def test_what_waits_for_ever_is_a_finding(only: Callable[..., list[Tried]], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fuzz_corpus, "WAITED", 2.0)
    monkeypatch.setattr(fuzz_corpus, "MOST", 1)
    (waits,) = only(seconds=5.0, waits=_waits)
    assert _as_expected(waits, "over 2.0 s")


@pytest.mark.slow
def test_the_deadline_ends_it_without_a_finding(only: Callable[..., list[Tried]]) -> None:
    """One target waits in its first input, the other would go on."""
    begin = time.time()
    slow, quick = sorted(
        only(seconds=1000.0, until=begin + 1.5, slow=_sleeps, quick=_reads),
        key=lambda tried: tried.number,
    )
    assert time.time() - begin < 6  # where the machine is busy; each of the two waits would take longer
    assert (slow.number, slow.cut, slow.findings) == (0, True, [])
    assert quick.number > 100
    assert quick.cut


@pytest.mark.slow
@pytest.mark.parametrize(("target", "code"), [(_reads, 0), (_raises, 1)])
def test_the_command_fails_where_something_is_found(
    target: fuzz.Target, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "csv").mkdir()
    (tmp_path / "csv" / "a").write_text("a" * 50)
    monkeypatch.setattr(fuzz, "CORPUS", tmp_path)
    monkeypatch.setattr(fuzz, "TARGETS", {"csv": target})
    monkeypatch.setattr(fuzz_corpus, "KEPT", tmp_path / "kept")
    monkeypatch.setattr(sys, "argv", ["fuzz_corpus", "every", "--seconds", "1"])
    fuzz_corpus._corpus.cache_clear()
    assert fuzz_corpus.main() == code
    assert ("too short" in capsys.readouterr().out) == bool(code)
    assert (tmp_path / "kept").exists() == bool(code)
    fuzz_corpus._corpus.cache_clear()


def test_inputs_are_the_same_in_every_run() -> None:
    before = [altered("csv", number) for number in range(20)]
    fuzz_corpus._corpus.cache_clear()
    assert [altered("csv", number) for number in range(20)] == before
    assert len(set(before)) > 15
