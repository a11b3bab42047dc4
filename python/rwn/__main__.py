"""`python -m rwn`, the same as the command `rwn`."""

from __future__ import annotations

from rwn_command import main

main()
