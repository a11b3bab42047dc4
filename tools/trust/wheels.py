"""Builds the wheel twice, from two folders, and compares their files and what they answer: `make wheels`.

Each is installed into an empty folder, and the demonstration is diagnosed with it. Exit code 1 where a byte differs
that is not the time of a file.
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
DEMO = """
import sys; sys.path.insert(0, sys.argv[1])
from pathlib import Path
import rwn
here = Path(rwn.__file__).parent
assert here.is_relative_to(sys.argv[1]), here
found = rwn.diagnose(here / "demo/train.csv", here / "demo/model.toml", heldout=here / "demo/heldout.csv", jobs=1)
sys.stdout.buffer.write(found.to_json())
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


def answer(wheel: Path, folder: Path) -> str:
    """Digest of diagnosis.json of the demonstration."""
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    apart = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([sys.executable, "-c", DEMO, str(folder)], env=apart, capture_output=True, check=True)
    return hashlib.sha256(done.stdout).hexdigest()


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
        answers = {answer(wheel, folder / "installed") for wheel, folder in zip(wheels, folders, strict=True)}
    page.show(
        "wheels", options.page,
        f"Two builds from two folders ({' '.join(options.settings) or 'as shipped'}): {len(first) - len(differ)} of "
        f"{len(first)} files have the same bytes{': not ' + ', '.join(differ) if differ else ''}; the two archives are "
        f"{'the same' if whole else 'not the same'} file; the demonstration has {len(answers)} diagnosis.json of them.",
    )  # fmt: skip
    return 1 if differ or len(answers) != 1 else 0


if __name__ == "__main__":
    sys.exit(main())
