"""rwn: name, model and prove what a DC-motor drive simulation leaves out, and draw where it lies."""

from __future__ import annotations

import sys as _sys

if _sys.argv[:1] == ["-m"] and "rwn" in _sys.orig_argv:  # `python -m rwn`, before __main__ has its turn
    import rwn_command as _rwn_command

    _rwn_command.end_at_ctrl_c()

from rwn._core import __version__ as __version__
from rwn.diagnose import diagnose as diagnose
from rwn.errors import InputError as InputError
from rwn.errors import NoResultError as NoResultError
from rwn.identify import Identification as Identification
from rwn.identify import identify as identify
from rwn.model.files import read_model as read_model
from rwn.model.model import Model as Model
from rwn.model.recordings import read_recordings as read_recordings
from rwn.networks.conventional_network import ConventionalNetwork as ConventionalNetwork
from rwn.networks.online_training import OnlineTraining as OnlineTraining
from rwn.networks.online_training import train_recurrent as train_recurrent
from rwn.networks.online_training import train_structured as train_structured
from rwn.networks.recurrent_network import RecurrentNetwork as RecurrentNetwork
from rwn.networks.side_by_side import SideBySide as SideBySide
from rwn.networks.side_by_side import train_side_by_side as train_side_by_side
from rwn.networks.structured_network import MotorParameters as MotorParameters
from rwn.networks.structured_network import StructuredNetwork as StructuredNetwork
from rwn.networks.training import Training as Training
from rwn.networks.wavelets import Wavelet as Wavelet
from rwn.recording.recording import Recording as Recording
from rwn.recording.recording import read_recording as read_recording
from rwn.report.diagnosis import Diagnosis as Diagnosis
from rwn.report.overlay import plot as plot
from rwn.report.saving import save as save
from rwn.simulate.simulation import Simulation as Simulation
from rwn.simulate.simulation import simulate as simulate
