"""The kinds of drive that a model can be of. A new one is a file and its line here."""

from __future__ import annotations

from rwn.model.drives.axis import AXIS
from rwn.model.drives.dc import DC
from rwn.model.drives.drive import Drive
from rwn.model.drives.lti import LTI
from rwn.model.drives.lti import MOST_ORDER as MOST_ORDER

KINDS: dict[str, Drive] = {drive.kind: drive for drive in (DC, AXIS, LTI)}
