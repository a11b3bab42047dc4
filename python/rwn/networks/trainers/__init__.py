"""Trainers of static networks; a new one is a file here and one entry in the registry."""

from __future__ import annotations

from rwn.networks.trainers.gradient_descent import GradientDescent
from rwn.networks.trainers.guarded_descent import GuardedDescent, GuardedTraining
from rwn.networks.trainers.levenberg_marquardt import LevenbergMarquardt
from rwn.networks.trainers.pattern_descent import PatternDescent
from rwn.networks.trainers.pattern_gauss_newton import PatternGaussNewton
from rwn.networks.trainers.recursive_gauss_newton import RecursiveFit, RecursiveGaussNewton
from rwn.networks.trainers.structured_levenberg_marquardt import StructuredFit, StructuredLevenbergMarquardt
from rwn.networks.trainers.variable_projection import VariableProjection
from rwn.networks.training import Trainer

TRAINERS: dict[str, type[Trainer]] = {
    trainer.name: trainer
    for trainer in (
        GradientDescent,
        PatternDescent,
        PatternGaussNewton,
        LevenbergMarquardt,
        VariableProjection,
    )
}

STRUCTURED_TRAINERS = {
    trainer.name: trainer
    for trainer in (GuardedDescent, RecursiveGaussNewton, StructuredLevenbergMarquardt)
}

__all__ = [
    "STRUCTURED_TRAINERS",
    "TRAINERS",
    "GradientDescent",
    "GuardedDescent",
    "GuardedTraining",
    "LevenbergMarquardt",
    "PatternDescent",
    "PatternGaussNewton",
    "RecursiveFit",
    "RecursiveGaussNewton",
    "StructuredFit",
    "StructuredLevenbergMarquardt",
    "Trainer",
    "VariableProjection",
]
