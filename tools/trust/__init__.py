"""How rwn is tested, as figures: the commands behind docs/testing.md. `python -m tools.trust.NAME --help`."""
