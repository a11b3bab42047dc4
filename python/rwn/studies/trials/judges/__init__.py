"""The judges: simulators that hold the truth of a trial. A new one is a file and its line here."""

from __future__ import annotations

from rwn.studies.trials.judges.judge import FINE as FINE
from rwn.studies.trials.judges.judge import Judge as Judge
from rwn.studies.trials.judges.judge import Run as Run
from rwn.studies.trials.judges.judge import State as State
from rwn.studies.trials.judges.mujoco import Mujoco
from rwn.studies.trials.judges.own import OwnPlant

JUDGES: dict[str, Judge] = {judge.name: judge for judge in (OwnPlant(), Mujoco())}
