from __future__ import annotations

from importlib.metadata import version

import rwn


def test_the_version_is_stated_once() -> None:
    assert rwn.__version__ == version("rwn")
