"""Mutation testing of the network kernels, by hand: `make mutants`.

Alters one line of a kernel at a time (a sign, a factor, a constant, a maximum, an index), builds the C++ tests for
the plainest instruction set in a copy, and runs those of the networks. A mutant that no test kills is listed; the
command fails where more than one in ten survive. KNOWN names those that cannot be killed, with the reason.
"""

from __future__ import annotations

import argparse
import random
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FILES = (
    "cpp/kernels/thesis_bounds.hpp",
    "cpp/kernels/recurrent_bounds.hpp",
    "cpp/kernels/recurrent_step.cpp",
    "cpp/kernels/structured_run.hpp",
    "cpp/include/rwn/networks/plant_gain.hpp",
)
TESTS = "*ecurrent*:*tructured*:*ThesisRates*:*PlantGain*:*SideBySide*:*side_by_side*"
# pattern, replacement, what it does; applied to one place of one line
CHANGES = (
    (r" \+ ", " - ", "sum to difference"),
    (r" - ", " + ", "difference to sum"),
    (r"(?<=[\w)\]]) \* (?=[\w(])", " / ", "product to quotient"),
    (r"\b1\.0\b", "2.0", "1 to 2"),
    (r"\b2\.0\b", "1.0", "2 to 1"),
    (r"\bmax\(([^,()]+), ", r"min_of(\1, ", "maximum to minimum"),
    (r"= -Pack", "= Pack", "sign"),
    (r"-\(v\[", "(v[", "sign"),
    (r"v\[1\]", "v[2]", "another parameter"),
    (r" \* t\.(phi|others|slope|root_wavelets)\b", "", "factor left out"),
    (r"t\.root_inputs \* ", "", "factor left out"),
    (r" < 1\.0", " < 0.5", "threshold"),
)
KNOWN = {
    "gain < 1e300": "no test comes near 1e300: the bound is meaningless long before",
    "discriminant >= 0.0": "at 0 both formulas are the same",
    "load(at + kShape * width)": "kShape is 0: adding and subtracting it is the same",
    "v + kWeightRow * width": "kWeightRow is 0: adding, subtracting and dividing it is the same",
}
MINIMUM = """\
RWN_INLINE double min_of(double a, double b) { return a < b ? a : b; }
RWN_INLINE Pack min_of(Pack a, Pack b) { return a.v < b.v ? a.v : b.v; }
"""


@dataclass(frozen=True)
class Mutant:
    """One altered line (counted from 1)."""

    path: str
    line: int
    before: str
    after: str
    what: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}, {self.what}: {self.before.strip()}  ->  {self.after.strip()}"


def mutants() -> Iterator[Mutant]:
    """Every change at every place of the kernels' code; comments and declarations stay."""
    for path in FILES:
        for number, text in enumerate((ROOT / path).read_text(encoding="utf-8").splitlines(), start=1):
            code, slashes, comment = text.partition("//")
            if code.lstrip().startswith(("#", "template", "namespace", "static_assert")):
                continue
            for pattern, replacement, what in CHANGES:
                for found in re.finditer(pattern, code):
                    new = code[: found.start()] + found.expand(replacement) + code[found.end() :]
                    yield Mutant(path, number, text, new + slashes + comment, what)


def build(copy: Path) -> bool:
    """Configures once, then compiles what changed; False where the mutant does not compile."""
    folder = copy / "build"
    if not (folder / "build.ninja").exists():
        options = ["-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DRWN_KERNELS_FOR=any", "-DRWN_BUILD_TESTS=ON"]
        command = ["cmake", "-S", copy, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *options]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    command = ["cmake", "--build", folder, "--target", "rwn_tests"]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def killed(copy: Path) -> bool:
    """Whether a test of the networks fails, crashes or hangs."""
    command = [copy / "build" / "rwn_tests", "--gtest_brief=1", f"--gtest_filter={TESTS}"]
    try:
        return subprocess.run(command, capture_output=True, timeout=60, check=False).returncode != 0
    except subprocess.TimeoutExpired:
        return True


def tried(mutant: Mutant, copy: Path) -> str:
    """`killed`, `survived` or `no mutant` (it does not compile)."""
    target = copy / mutant.path
    good = target.read_text(encoding="utf-8")
    lines = good.splitlines(keepends=True)
    lines[mutant.line - 1] = mutant.after + "\n"
    text = "".join(lines)
    if "min_of(" in mutant.after:
        opening = re.search(r"namespace rwn::RWN_ISA \{\n", text)
        text = text[: opening.end()] + MINIMUM + text[opening.end() :] if opening else text
    try:
        target.write_text(text, encoding="utf-8")
        if not build(copy):
            return "no mutant"
        return "killed" if killed(copy) else "survived"
    finally:
        target.write_text(good, encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=60, help="mutants, drawn at random; 0 for all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--copy", type=Path, default=ROOT / "build" / "mutants", help="where the altered copy is built")
    asked = parser.parse_args()
    every = list(mutants())
    random.Random(asked.seed).shuffle(every)
    chosen = every[: asked.count] if asked.count else every
    for name in ("cpp", "cmake"):
        shutil.copytree(ROOT / name, asked.copy / name, dirs_exist_ok=True)
    for name in ("CMakeLists.txt", "pyproject.toml"):
        shutil.copy(ROOT / name, asked.copy / name)
    if not build(asked.copy) or killed(asked.copy):
        sys.exit("mutants: the kernels as they are do not build or do not pass")
    found: dict[str, list[Mutant]] = {"killed": [], "survived": [], "no mutant": []}
    for k, mutant in enumerate(chosen, start=1):
        verdict = tried(mutant, asked.copy)
        found[verdict].append(mutant)
        print(f"[{k}/{len(chosen)}] {verdict}: {mutant}", flush=True)
    survivors = [m for m in found["survived"] if not any(text in m.before for text in KNOWN)]
    for mutant in found["survived"]:
        why = next((reason for text, reason in KNOWN.items() if text in mutant.before), "no reason known")
        print(f"survived: {mutant}\n    {why}")
    count = len(found["killed"]) + len(survivors)
    print(f"{len(found['killed'])} of {count} killed, of {len(every)} possible mutants {len(chosen)} tried")
    sys.exit(10 * len(survivors) > count)


if __name__ == "__main__":
    main()
