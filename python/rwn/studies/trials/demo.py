"""Makes the recordings of `rwn demo`: a 40 W motor whose model file leaves out the brushes' dry friction.

`python -m rwn.trials.demo [FOLDER]` writes model.toml, train.csv and heldout.csv; without a folder they go to
`python/rwn/demo` of the checkout it is started in. The result is the same on every call.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from rwn.studies.trials.bench import Experiment, Noise, Setup, measure
from rwn.studies.trials.conceal import Nominal
from rwn.studies.trials.effects import EFFECTS
from rwn.studies.trials.motors import MOTORS, plant_of
from rwn.studies.trials.plant import Values
from rwn.studies.trials.trial_files import model_toml, write_recording

STREAM = 2013  # the year of the thesis
RATE = 1000.0
COULOMB_TORQUE = 0.0045  # N m, about a tenth of the torque at full current
OFF = {  # what the data sheet says over what is true
    "resistance": 1.06,
    "torque_constant": 0.97,
    "back_emf_constant": 0.97,
    "inertia": 0.93,
    "viscous_friction": 1.3,
}
UNCERTAINTY = {
    "resistance": 0.07,
    "torque_constant": 0.04,
    "back_emf_constant": 0.04,
    "inertia": 0.08,
    "viscous_friction": 0.4,
}


def write_demo(folder: Path) -> None:
    """Writes the three files of the demonstration to `folder`."""
    motor = next(motor for motor in MOTORS if motor.name == "M06-40W-24V")
    true = motor.nominal(dry=False)
    nominal: Values = {name: value * OFF.get(name, 1.0) for name, value in true.items()}
    effect = EFFECTS["coulomb-friction"]
    plant = plant_of(true) | effect.build({"coulomb_torque": COULOMB_TORQUE}, true)
    setup = Setup(motor, RATE, ("V", "i", "w"))
    noise = Noise(speed=0.35, current=0.015)
    rng = np.random.default_rng(STREAM)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "model.toml").write_text(model_toml(Nominal(nominal, UNCERTAINTY)), encoding="utf-8")
    for number, (name, kind, rows) in enumerate((("train", "multisine", 5000), ("heldout", "cl_trap", 4000))):
        trace = setup.run(Experiment(kind, rows, 6.0, (STREAM, number)), plant)
        write_recording(folder / f"{name}.csv", measure(trace, setup, noise, 0.0, rng))


if __name__ == "__main__":
    write_demo(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("python/rwn/demo"))
