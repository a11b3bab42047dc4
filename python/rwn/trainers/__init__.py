"""Trainers of static networks; a new one is a file here and one entry in the registry."""

from __future__ import annotations

from rwn.trainers.gradient_descent import GradientDescent
from rwn.trainers.levenberg_marquardt import LevenbergMarquardt
from rwn.trainers.pattern_descent import PatternDescent
from rwn.trainers.pattern_gauss_newton import PatternGaussNewton
from rwn.trainers.variable_projection import VariableProjection
from rwn.training import Trainer

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

__all__ = [
    "TRAINERS",
    "GradientDescent",
    "LevenbergMarquardt",
    "PatternDescent",
    "PatternGaussNewton",
    "Trainer",
    "VariableProjection",
]
