"""Builds the wheel twice, from two folders, and compares their files and what they answer: `make wheels`.

Each is installed by pip into an empty environment, with what it says it needs and no more, numpy and scipy in the
versions of this environment: every module must load there, and the command diagnoses the demonstration. So is the wheel
that each other --python builds, in an environment of its own. Exit code 1 where a byte differs that is not the time of
a file, where a committed file of the package is missing, or where the installed wheels answer differently.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import subprocess
import sys
import zipfile
from importlib.metadata import version
from pathlib import Path

from tools.trust import page
from tools.trust.aside import folder_aside

NUMERICS = ("numpy", "scipy")  # of the same version under every Python: the last digits are theirs
ROOT = Path(__file__).resolve().parents[2]
EVERY_MODULE = """
import importlib, pkgutil, sys
import rwn
assert rwn.__file__.startswith(sys.prefix), rwn.__file__
names = [module.name for module in pkgutil.walk_packages(rwn.__path__, "rwn.") if not module.name.endswith("__main__")]
for name in names:
    importlib.import_module(name)
print(len(names))
"""


def build(python: str, folder: Path, commit: str, settings: list[str]) -> Path:
    """A wheel of a commit, compiled in a folder of its own; by another Python with what its pip fetches to build it."""
    source = folder / "source"
    subprocess.run(["git", "clone", "-q", str(ROOT), str(source)], check=True)
    subprocess.run(["git", "checkout", "-q", "--detach", commit], cwd=source, check=True)
    words = [word for setting in settings for word in ("-C", setting)]
    here = ["--no-build-isolation"] if python == sys.executable else []
    wheel_of = [python, "-m", "pip", "wheel", "-q", "--disable-pip-version-check", "--no-deps", "-w", str(folder)]
    subprocess.run([*wheel_of, *here, *words, str(source)], env=apart(), check=True)
    (wheel,) = folder.glob("*.whl")
    return wheel


def apart() -> dict[str, str]:
    """The environment of a process that is to find nothing of this checkout."""
    return {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}


def contents(wheel: Path) -> dict[str, str]:
    """Digest of each file."""
    with zipfile.ZipFile(wheel) as archive:
        return {name: hashlib.sha256(archive.read(name)).hexdigest() for name in archive.namelist()}


def output(*words: str) -> str:
    """Of a command in the checkout."""
    return subprocess.run(words, cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def committed(commit: str) -> set[str]:
    """The files of the packages, as a wheel names them."""
    listed = output("git", "ls-tree", "-r", "--name-only", commit, "python").splitlines()
    return {name.removeprefix("python/") for name in listed}


def installed(python: str, wheel: Path, folder: Path) -> tuple[str, str, str]:
    """From an empty environment with the wheel: its Python, how many modules load, the digest of the demonstration."""
    subprocess.run([python, "-m", "venv", str(folder / "venv")], env=apart(), check=True)

    def run(*words: str) -> str:
        """A command of the environment, away from the checkout."""
        command = [str(folder / "venv" / "bin" / words[0]), *words[1:]]
        return subprocess.run(command, cwd=folder, env=apart(), check=True, stdout=subprocess.PIPE, text=True).stdout

    run("pip", "install", "-q", "--disable-pip-version-check", str(wheel), *(f"{n}=={version(n)}" for n in NUMERICS))
    run("pip", "check")
    modules = run("python", "-c", EVERY_MODULE).strip()
    run("rwn", "demo", "--out", "demo-out")
    package = run("python", "-c", "import rwn; print(rwn.__path__[0])").strip()  # the recordings lie there
    found = (folder / "demo-out" / "diagnosis.json").read_bytes().replace(package.encode(), b"")
    return run("python", "-V").strip(), modules, hashlib.sha256(found).hexdigest()[:12]


def main() -> int:
    """Prints what is the same; 1 where anything is not."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-C", dest="settings", action="append", default=[], help="a setting of scikit-build-core")
    parser.add_argument("--python", action="append", default=[], help="another Python, as python3.12; repeatable")
    options = page.parsed(parser, "wheels")
    commit, pythons = output("git", "rev-parse", "HEAD"), [sys.executable, sys.executable, *options.python]
    wheels, found = list[Path](), list[tuple[str, str, str]]()
    with folder_aside("wheels") as aside:
        for k, python in enumerate(pythons):
            folder = aside / ("a", "another")[k % 2] / str(k)  # paths of two lengths
            folder.mkdir(parents=True)
            wheels.append(build(python, folder, commit, options.settings))
            print(f"built: {wheels[-1]}", file=sys.stderr, flush=True)
            found.append(installed(python, wheels[-1], folder))
            print("installed:", *found[-1], file=sys.stderr, flush=True)
        first, second = map(contents, wheels[:2])
        whole = len({hashlib.sha256(wheel.read_bytes()).hexdigest() for wheel in wheels[:2]}) == 1
        missing = sorted(committed(commit) - set.intersection(*(set(contents(wheel)) for wheel in wheels)))
    differ = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
    page.show(
        "wheels", options.page,
        f"Two builds from two folders ({' '.join(options.settings) or 'as shipped'}): {len(first) - len(differ)} of "
        f"{len(first)} files have the same bytes{': not ' + ', '.join(differ) if differ else ''}; the two archives are "
        f"{'the same' if whole else 'not the same'} file. {len(missing)} committed files of the packages are missing"
        f"{': ' + ', '.join(missing) if missing else ''}.",
        "Each was installed by pip into an empty environment with what it requires alone, and so was the wheel of each "
        f"other Python, all with {' and '.join(f'{n} {version(n)}' for n in NUMERICS)}, whose rounding differs between "
        "versions: modules that load there, and the digest of the diagnosis.json that `rwn demo` writes.",
        page.table(("built and run by", "modules", "diagnosis.json"), found),
    )  # fmt: skip
    return 1 if differ or missing or len({answer for _, _, answer in found}) != 1 else 0


if __name__ == "__main__":
    sys.exit(main())
