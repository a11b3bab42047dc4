"""Builds the wheel twice, from two folders, and compares their files and what they answer: `make wheels`.

Each is installed by pip into an empty environment, with what it says it needs and no more: every module must load
there, and the command diagnoses the demonstration. Exit code 1 where a byte differs that is not the time of a file,
where a committed file of the package is missing, or where an installed wheel fails.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from tools.trust import page

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


def build(folder: Path, settings: list[str]) -> Path:
    """A wheel of what is committed, compiled in a folder of its own."""
    source = folder / "source"
    subprocess.run(["git", "clone", "-q", str(ROOT), str(source)], check=True)
    words = [word for setting in settings for word in ("-C", setting)]
    wheel_of = [sys.executable, "-m", "pip", "wheel", "-q", "--no-build-isolation", "--no-deps", "-w", str(folder)]
    subprocess.run([*wheel_of, *words, str(source)], check=True)
    (wheel,) = folder.glob("*.whl")
    return wheel


def contents(wheel: Path) -> dict[str, str]:
    """Digest of each file."""
    with zipfile.ZipFile(wheel) as archive:
        return {name: hashlib.sha256(archive.read(name)).hexdigest() for name in archive.namelist()}


def committed() -> set[str]:
    """The files of the packages, as a wheel names them."""
    listed = subprocess.run(["git", "ls-files", "python"], cwd=ROOT, check=True, capture_output=True, text=True)
    return {name.removeprefix("python/") for name in listed.stdout.splitlines()}


def installed(wheel: Path, folder: Path) -> tuple[int, str]:
    """From an empty environment with the wheel: how many modules load, and the digest of the demonstration's result."""
    subprocess.run([sys.executable, "-m", "venv", str(folder / "venv")], check=True)
    apart = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def run(*words: str) -> str:
        """A command of the environment, away from the checkout."""
        command = [str(folder / "venv" / "bin" / words[0]), *words[1:]]
        return subprocess.run(command, cwd=folder, env=apart, check=True, stdout=subprocess.PIPE, text=True).stdout

    run("pip", "install", "-q", "--disable-pip-version-check", str(wheel))
    run("pip", "check")
    modules = int(run("python", "-c", EVERY_MODULE))
    run("rwn", "demo", "--out", "demo-out")
    found = (folder / "demo-out" / "diagnosis.json").read_bytes()
    return modules, hashlib.sha256(found.replace(str(folder).encode(), b"")).hexdigest()  # it names its recordings


def main() -> int:
    """Prints what is the same; 1 where anything is not."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-C", dest="settings", action="append", default=[], help="a setting of scikit-build-core")
    options = page.parsed(parser, "wheels")
    with tempfile.TemporaryDirectory(prefix="rwn-wheels-") as name:
        folders = [Path(name) / "a", Path(name) / "another"]
        for folder in folders:
            folder.mkdir()
        wheels = [build(folder, options.settings) for folder in folders]
        first, second = map(contents, wheels)
        differ = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
        whole = len({hashlib.sha256(wheel.read_bytes()).hexdigest() for wheel in wheels}) == 1
        missing = sorted(committed() - first.keys())
        found = [installed(wheel, folder) for wheel, folder in zip(wheels, folders, strict=True)]
    modules, answers = found[0][0], {answer for _, answer in found}
    page.show(
        "wheels", options.page,
        f"Two builds from two folders ({' '.join(options.settings) or 'as shipped'}): {len(first) - len(differ)} of "
        f"{len(first)} files have the same bytes{': not ' + ', '.join(differ) if differ else ''}; the two archives are "
        f"{'the same' if whole else 'not the same'} file. {len(missing)} committed files of the packages are missing"
        f"{': ' + ', '.join(missing) if missing else ''}.",
        f"Each was installed by pip into an empty environment with what it requires alone: {modules} modules load, and "
        f"`rwn demo` writes {len(answers)} diagnosis.json.",
    )  # fmt: skip
    return 1 if differ or missing or len(answers) != 1 else 0


if __name__ == "__main__":
    sys.exit(main())
