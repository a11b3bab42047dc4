"""Mutation testing of the network kernels, by hand: `make mutants`, with `--count 30` a sample.

Alters one line of a kernel at a time (a sign, a factor, a constant, a maximum, an index) in a copy that is built for
the plainest instruction set, compiles the units that decide (UNITS), links the C++ tests and runs those of the
networks until one fails. The command fails where more than one mutant in ten survives. SAME names the mutants that
compute the same as the kernel, which no test can kill: they are listed and do not count. Run again, it tries those
that survived; with other kernels, and with `--anew`, all.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import random
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STRUCTURED, RECURRENT = "cpp/kernels/structured_step.cpp", "cpp/kernels/recurrent_step.cpp"
UNITS = {
    "cpp/kernels/thesis_bounds.hpp": (STRUCTURED,),
    "cpp/kernels/structured_run.hpp": (STRUCTURED,),
    "cpp/kernels/recurrent_bounds.hpp": (RECURRENT,),
    "cpp/kernels/recurrent_step.cpp": (RECURRENT,),
    # the batch trainers, which call it too, keep the right one: their tests cannot help
    "cpp/include/rwn/kernels/plant_gain.hpp": (STRUCTURED, "cpp/tests/networks/structured_network_test.cpp"),
}
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
# file, what the mutant's line has and the kernel's has not, why both compute the same
SAME = tuple(
    ("recurrent_step.cpp", has, "an offset of 0: added, taken off or divided, it is the same")
    for has in ("- kWeightRow * width", "kWeightRow / width", "- kShape * width", "kShape / width")
)
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

    @property
    def same(self) -> str:
        """Why it computes what the kernel does; empty where it does not, or nobody has said so."""
        mine = ((has, why) for file, has, why in SAME if self.path.endswith(file))
        return next((why for has, why in mine if has in self.after and has not in self.before), "")


def mutants() -> Iterator[Mutant]:
    """Every change at every place of the kernels' code; comments and declarations stay."""
    for path in UNITS:
        for number, text in enumerate((ROOT / path).read_text(encoding="utf-8").splitlines(), start=1):
            code, slashes, comment = text.partition("//")
            if code.lstrip().startswith(("#", "template", "namespace", "static_assert")):
                continue
            for pattern, replacement, what in CHANGES:
                for found in re.finditer(pattern, code):
                    new = code[: found.start()] + found.expand(replacement) + code[found.end() :]
                    yield Mutant(path, number, text, new + slashes + comment, what)


class Copy:
    """A built copy of the C++ sources, in which one line at a time is altered."""

    def __init__(self, root: Path) -> None:
        self.root, self.folder = root.resolve(), root.resolve() / "build"
        for name in ("cpp", "cmake"):
            shutil.copytree(ROOT / name, root / name, dirs_exist_ok=True)
        for name in ("CMakeLists.txt", "pyproject.toml"):
            shutil.copy(ROOT / name, root / name)
        options = ["-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DRWN_KERNELS_FOR=any", "-DRWN_BUILD_TESTS=ON"]
        options += ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"]
        subprocess.run(
            ["cmake", "-S", root, "-B", self.folder, "-G", "Ninja", *options], check=True, stdout=subprocess.DEVNULL
        )
        subprocess.run(["ninja", "rwn_tests"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        units = {unit for units in UNITS.values() for unit in units}
        listed = json.loads((self.folder / "compile_commands.json").read_text(encoding="utf-8"))
        self.compile = {
            str(Path(one["file"]).relative_to(self.root)): shlex.split(one["command"])
            for one in listed
            if str(Path(one["file"]).relative_to(self.root)) in units
        }
        self.objects = {unit: words[words.index("-o") + 1] for unit, words in self.compile.items()}
        self.link = self._link()
        # anew: where an earlier run was killed, ninja takes a mutant's object for that of the restored source
        if not self.made(sorted(units)) or self.fails():
            sys.exit("mutants: the kernels as they are do not build or do not pass")
        self.right = {unit: (self.folder / path).read_bytes() for unit, path in self.objects.items()}

    def _link(self) -> list[str]:
        """As ninja links the tests, the kernels' objects before the library, whose own are then not taken."""
        asked = ["ninja", "-t", "commands", "rwn_tests"]
        said = subprocess.run(asked, cwd=self.folder, check=True, capture_output=True, text=True).stdout
        words = shlex.split(said.splitlines()[-1].split("&&")[1])
        at = words.index("-o")
        words[at + 1] = "mutant_tests"
        return [*words[:at], self.objects[STRUCTURED], self.objects[RECURRENT], *words[at:]]

    def made(self, units: Sequence[str]) -> bool:
        """Compiles the units and links; False where they do not compile."""
        commands = [*(self.compile[unit] for unit in units), self.link]
        return all(self._run(command).returncode == 0 for command in commands)

    def fails(self) -> bool:
        """Whether a test of the networks fails, crashes or takes more than a minute of processor time."""
        tests = ["./mutant_tests", "--gtest_fail_fast", f"--gtest_filter={TESTS}"]
        return self._run(["prlimit", "--cpu=60", *tests]).returncode != 0

    def _run(self, command: Sequence[str]) -> subprocess.CompletedProcess[bytes]:
        return subprocess.run(command, cwd=self.folder, capture_output=True, check=False)

    def tried(self, mutant: Mutant) -> str:
        """`killed`, `survived` or `no mutant` (it does not compile)."""
        target, units = self.root / mutant.path, UNITS[mutant.path]
        right = target.read_text(encoding="utf-8")
        try:
            target.write_text(altered(right, mutant), encoding="utf-8")
            if not self.made(units):
                return "no mutant"
            return "killed" if self.fails() else "survived"
        finally:
            target.write_text(right, encoding="utf-8")
            for unit in units:
                (self.folder / self.objects[unit]).write_bytes(self.right[unit])


def altered(text: str, mutant: Mutant) -> str:
    """The source with the mutant's line, and with the minimum where it needs one."""
    lines = text.splitlines(keepends=True)
    lines[mutant.line - 1] = mutant.after + "\n"
    text = "".join(lines)
    opening = re.search(r"namespace rwn::RWN_ISA \{\n", text)
    if "min_of(" in mutant.after and opening:
        text = text[: opening.end()] + MINIMUM + text[opening.end() :]
    return text


class Verdicts:
    """What has been said of mutants of these kernels; those that survived are forgotten, for there may be new tests."""

    def __init__(self, path: Path, *, anew: bool) -> None:
        self.path = path
        kernels = b"".join((ROOT / name).read_bytes() for name in UNITS)
        self.kernels = hashlib.sha256(kernels).hexdigest()
        kept = json.loads(path.read_text(encoding="utf-8")) if path.exists() and not anew else {}
        self.words: dict[str, str] = kept.get("words", {}) if kept.get("kernels") == self.kernels else {}

    def of(self, mutant: Mutant, copy: Copy) -> str:
        """`killed`, `survived`, `same` or `no mutant`."""
        word = self.words.get(str(mutant)) or copy.tried(mutant)
        if word != "survived":
            self.words[str(mutant)] = word
            self.path.write_text(json.dumps({"kernels": self.kernels, "words": self.words}), encoding="utf-8")
        return "same" if word == "survived" and mutant.same else word


def page(found: dict[str, list[Mutant]], every: int) -> str:
    """What was killed by file, and every survivor with its reason, in Markdown."""
    from rwn.studies.made import TESTS, made

    here = made(Path(__file__), also=TESTS)
    killed, survived = len(found["killed"]), len(found["survived"])
    machine, tried = here.machine.split(", Python")[0], sum(map(len, found.values()))
    rest = "" if tried == every else " (the others not yet)"
    lines = [
        "# Altered kernels\n",
        "`make mutants` alters one line of the network kernels at a time (a sign, a factor, a constant, a maximum, an",
        "index) and asks whether a C++ test of the networks fails. Written by `tools/mutants.py`; do not edit.\n",
        f"{here.date}, {here.commit}, {machine}: {tried} of {every} mutants tried{rest},",
        f"{len(found['no mutant'])} of which do not compile. Of those that compute something else "
        f"{killed} of {killed + survived} are killed.\n",
        "| file | killed | survived | computes the same |",
        "|---|---|---|---|",
    ]
    for path in (*UNITS, "all"):
        counts = (sum(path in ("all", m.path) for m in found[word]) for word in ("killed", "survived", "same"))
        lines.append(f"| {path} | " + " | ".join(map(str, counts)) + " |")
    for word, title in (("survived", "Survived"), ("same", "Compute the same, so that no test can kill them")):
        if found[word]:
            lines += [f"\n## {title}\n", "| where | what | the mutant's line | reason |", "|---|---|---|---|"]
            lines += [row(mutant) for mutant in sorted(found[word], key=lambda m: (m.path, m.line))]
    return "\n".join(lines) + "\n"


def row(mutant: Mutant) -> str:
    """A survivor in one line."""
    code = mutant.after.partition("//")[0].strip().replace("|", "\\|")
    return f"| {Path(mutant.path).name}:{mutant.line} | {mutant.what} | `{code}` | {mutant.same or 'no test asks'} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=0, help="mutants, drawn at random; 0 for all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--copy", type=Path, default=ROOT / "build" / "mutants", help="where the altered copy is built")
    parser.add_argument("--anew", action="store_true", help="try those too that have been killed before")
    parser.add_argument("--page", type=Path, help="the page to write")
    asked = parser.parse_args()
    every = list(mutants())
    random.Random(asked.seed).shuffle(every)
    chosen = every[: asked.count] if asked.count else every
    copy = Copy(asked.copy)
    found: dict[str, list[Mutant]] = {"killed": [], "survived": [], "same": [], "no mutant": []}
    verdicts = Verdicts(asked.copy / "verdicts.json", anew=asked.anew)
    for k, mutant in enumerate(chosen, start=1):
        word = verdicts.of(mutant, copy)
        found[word].append(mutant)
        print(f"[{k}/{len(chosen)}] {word}: {mutant}", flush=True)
    if asked.page:
        asked.page.write_text(page(found, len(every)), encoding="utf-8")
    killed, survived = len(found["killed"]), len(found["survived"])
    print(f"{killed} of {killed + survived} killed, {len(found['same'])} compute the same; {len(every)} possible")
    sys.exit(10 * survived > killed + survived)


if __name__ == "__main__":
    main()
