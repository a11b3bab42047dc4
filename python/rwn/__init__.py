"""rwn: locate, name, model and prove what a DC-motor drive simulation leaves out."""

from __future__ import annotations

from rwn._core import __version__ as __version__
from rwn.conventional_network import ConventionalNetwork as ConventionalNetwork
from rwn.diagnose import diagnose as diagnose
from rwn.diagnosis import Diagnosis as Diagnosis
from rwn.errors import InputError as InputError
from rwn.identify import Fit as Fit
from rwn.identify import identify as identify
from rwn.model import Model as Model
from rwn.model import read_model as read_model
from rwn.online_training import OnlineTraining as OnlineTraining
from rwn.online_training import train_recurrent as train_recurrent
from rwn.online_training import train_structured as train_structured
from rwn.recording import Recording as Recording
from rwn.recording import read_recording as read_recording
from rwn.recurrent_network import RecurrentNetwork as RecurrentNetwork
from rwn.side_by_side import SideBySide as SideBySide
from rwn.side_by_side import train_side_by_side as train_side_by_side
from rwn.simulation import Simulation as Simulation
from rwn.simulation import simulate as simulate
from rwn.structured_network import MotorParameters as MotorParameters
from rwn.structured_network import StructuredNetwork as StructuredNetwork
from rwn.training import Training as Training
from rwn.wavelets import Wavelet as Wavelet
