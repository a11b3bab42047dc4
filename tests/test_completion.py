"""What Tab offers, asked as a shell asks it."""

from __future__ import annotations

import pytest

from command_line import Run
from rwn.model import vocabulary
from rwn.recording.profiles import PROFILES


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("rwn effects coulomb-", ["coulomb-friction"]),
        ("rwn effects ", list(vocabulary.table())),
        ("rwn diagnose --profile ", list(PROFILES)),
        ("rwn check a.csv --profile s", ["sinamics", "sysid"]),
        ("rwn evidence un", ["undc"]),
        ("rwn iden", ["identify"]),
    ],
)
def test_the_shell_is_offered(words: str, offered: list[str], run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("_RWN_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(words.count(" ")))
    code, said, error = run()
    assert (code, error) == (0, "")
    assert said.split() == offered


def test_the_shell_completes_rwn_and_no_other_command(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """As `python -m rwn` it installed a completion of every `python`."""
    monkeypatch.setenv("_RWN_COMPLETE", "source_bash")
    code, said, _ = run()
    assert code == 0
    assert said.split()[-1] == "rwn"
    assert "python" not in said
