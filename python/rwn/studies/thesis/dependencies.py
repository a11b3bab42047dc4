"""What a result depends on: the sources that its experiment reaches by imports, and the compiled core."""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np

from rwn import _core


@cache
def fingerprint(module: str, count: str, seeds: int | None = None) -> str:
    """Hash of every source of rwn that `module` reaches, of the extension, of numpy's version, of the instruction
    set, of the count and of the seeds; another one means that a result must be made again."""
    digest = hashlib.sha256(f"{count} {seeds} {np.__version__} {_core.isa()}".encode())
    for name, path in sorted(sources(module).items()):
        digest.update(name.encode() + path.read_bytes())
    digest.update(_extension())
    return digest.hexdigest()[:16]


@cache
def _extension() -> bytes:
    return Path(_core.__file__).read_bytes()


def sources(module: str) -> dict[str, Path]:
    """Files by module name: `module` and the modules of rwn that it imports, and those that they import."""
    found: dict[str, Path] = {}
    waiting = [module]
    while waiting:
        name = waiting.pop()
        path = _source(name)
        if path is None or name in found or name == "rwn":
            continue
        found[name] = path
        waiting += [*_imports(path), name.rpartition(".")[0]]
    return found


def _source(module: str) -> Path | None:
    loaded = getattr(sys.modules.get(module), "__file__", None)
    if loaded is None and module:
        try:
            spec = importlib.util.find_spec(module)
        except ModuleNotFoundError:  # an attribute of a module, not a module
            return None
        loaded = spec.origin if spec is not None else None
    return Path(loaded) if loaded is not None and loaded.endswith(".py") else None


def _imports(path: Path) -> Iterator[str]:
    """Names that a file imports from rwn; of `import rwn` those that it uses, not the whole package."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level == 0 and (node.module or "").split(".")[0] == "rwn":
            for alias in node.names:
                yield from (node.module or "", f"{node.module}.{alias.name}")
                if node.module == "rwn":
                    yield _exports().get(alias.name, "")
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.startswith("rwn."))
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "rwn":
            yield _exports().get(node.attr, "")


@cache
def _exports() -> dict[str, str]:
    """Module by name, of what `import rwn` offers."""
    path = _source("rwn")
    if path is None:
        return {}
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {
        alias.asname or alias.name: node.module or ""
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
