"""Effects found by a word, on the command line and in the shell."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from command_line import Run
from rwn.model.effect_search import effects_by_word
from rwn.model.vocabulary import table


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["friction"], {"coulomb-friction", "stribeck-friction", "asymmetric-friction"}),
        (["dry", "friction"], {"coulomb-friction", "stribeck-friction"}),
        (["frcition"], {"coulomb-friction", "viscous-friction"}),
        (["frction"], {"coulomb-friction", "viscous-friction"}),
        (["dry", "frction"], {"coulomb-friction", "stribeck-friction"}),
        (["sensor"], {"sensor-bias", "speed-sensor-lag"}),
    ],
)
def test_effects_are_found_by_a_word_and_by_one_like_it(run: Run, words: list[str], names: set[str]) -> None:
    code, out, _ = run("effects", *words)
    assert code == 0
    shown = {line.split()[0] for line in out.splitlines()}
    assert names <= shown
    assert not shown & {"input-delay", "magnetic-saturation"}, "reaction and direction are no friction"


@pytest.mark.parametrize("word", ["Stribeck", "stribek"])
def test_a_word_that_means_one_effect_shows_it(run: Run, word: str) -> None:
    code, out, _ = run("effects", word)
    assert code == 0
    assert out.startswith("stribeck-friction: ")
    assert "static_torque T_s [N m]" in out


def test_a_word_that_means_none_is_refused(run: Run) -> None:
    code, _, err = run("effects", "gravitation")
    assert code == 2
    assert "no effect mentions 'gravitation'" in err


def test_the_shell_completes_commands_and_effects() -> None:
    def completed(line: str) -> list[str]:
        asked = {"_RWN_COMPLETE": "complete_bash", "COMP_WORDS": line, "COMP_CWORD": str(line.count(" "))}
        code = "import sys; sys.argv = ['rwn']; from rwn.cli import main; main()"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=os.environ | asked)
        return done.stdout.split()

    assert completed("rwn diag") == ["diagnose"]
    assert completed("rwn effects stri") == ["stribeck-friction"]


def test_effects_prints_the_table(run: Run) -> None:
    code, out, _ = run("effects")
    assert code == 0
    assert "coulomb-friction" in out
    code, out, _ = run("effects", "stribeck-friction")
    assert "stribeck_speed" in out
    assert "source:" in out


def test_signs_alone_are_no_word() -> None:
    assert effects_by_word("?! --", table()) == ()
    assert effects_by_word("", table()) == ()
