"""How recordings were made, as the best explanation of them shows it: filters of the sensors, levels by the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import reduce

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.residuals import Statistics, statistics
from rwn.measurement.filter_colour import SensorFilter, coloured_noise
from rwn.measurement.known_filters import filtered
from rwn.measurement.lasting_noise import lasting_noise
from rwn.measurement.levels import Level, all_levels, as_described, can_differ, frictions, with_levels
from rwn.measurement.sensor_filter import filters_again, sensor_filters, shown_in_noise
from rwn.name.uneven import LevelsTest, uneven_beside
from rwn.parallel import side_by_side

SINGLE = 3  # explanations by one effect that what differs from recording to recording is asked beside
NEXT_TO_NOTHING = 0.005  # share of a squared error above the noise that is not worth a sentence
CHANGES = 2  # times that filters which are known may be found to be others; each costs a search


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """Recordings and what is known of how they were made."""

    as_prepared: Problem  # without filters of the sensors
    filters: tuple[SensorFilter, ...] = ()
    changes: int = 0  # times that filters have turned out to be others
    supposed: bool = False  # the recordings are of several machines, which has to leave noise alone
    of_one_machine: bool = False  # that was supposed in vain

    @property
    def problem(self) -> Problem:
        """What is to be explained."""
        return filtered(self.as_prepared, self.filters)

    def otherwise(
        self, problem: Problem, best: Fit, *, completely: bool, others: Sequence[Fit] = ()
    ) -> Measurement | None:  # fmt: skip
        """The measurement that the best explanation of `problem` shows; None: this one.

        `completely`: whether all is asked that several effects at once may show, not only what single ones do.
        `others`: explanations of which a simpler one may be right, where the best has made do without what differs from
        recording to recording.
        """
        filters = self._filters(problem, best, completely)
        if filters != self.filters:
            again = _of_motion(filters) != _of_motion(self.filters)
            return replace(self, filters=filters, changes=self.changes + (again and bool(self.filters)))
        levels = self._levels(problem, best, _simpler(others, best)) if completely else []
        if not levels:
            return None
        supposed = self.supposed or any(level.lasting for level in levels)
        return replace(self, as_prepared=reduce(with_levels, levels, self.as_prepared), supposed=supposed)

    def in_noise(self, problem: Problem, best: Fit) -> Measurement | None:
        """The measurement with filters that the noise itself shows beside an explanation that may lack effects."""
        if self.filters or problem.drive.coefficients or not shown_in_noise(problem, best):
            return None
        filters = sensor_filters(problem, best)
        return replace(self, filters=filters) if filters else None

    def _levels(self, problem: Problem, best: Fit, simpler: Sequence[Fit]) -> list[Level]:
        """What differs from recording to recording of what is not known to do so, the most certain first.

        Physics that is missing makes the numbers of a machine differ too: those are asked only where more than noise is
        left, and held to be several machines' only where that leaves noise alone or next to nothing.
        """
        found = list[Level]()
        while level := self._level(problem, best, simpler):
            found.append(as_described(level[1].problem, level[1].fit, level[0]))
            problem, best, simpler = level[1].problem, level[1].fit, ()
        return found

    def _level(self, problem: Problem, best: Fit, simpler: Sequence[Fit]) -> tuple[Level, LevelsTest] | None:
        done = statistics(problem, best).at_the_floor
        asked = frictions(problem) if done else all_levels(problem)
        asked = [level for level in asked if can_differ(problem, level) and not (level.lasting and self.of_one_machine)]
        pairs = [(level, this) for this in (best, *(() if done else simpler)) for level in asked]
        tried = side_by_side(lambda pair: (pair[0], uneven_beside(problem, best, *pair)), pairs)
        decisive = [row for row in tried if row[1].is_decisive]
        return max(decisive, key=lambda row: row[1].log_odds) if decisive else None

    def _filters(self, problem: Problem, best: Fit, completely: bool) -> tuple[SensorFilter, ...]:
        if problem.drive.coefficients:
            return self.filters
        known = _of_motion(self.filters)
        found = self._filters_of_motion(problem, best, known, completely)
        if found != known:
            return found
        coloured = coloured_noise(problem, problem.residuals(best.vector, best.active))
        coloured += [f for f in lasting_noise(problem, best) if f.signal not in {other.signal for other in coloured}]
        return (*self.filters, *(f for f in coloured if f.signal not in problem.coloured))

    def _filters_of_motion(
        self, problem: Problem, best: Fit, known: tuple[SensorFilter, ...], completely: bool
    ) -> tuple[SensorFilter, ...]:  # fmt: skip
        if not known:
            return sensor_filters(problem, best)
        if not completely or self.changes == CHANGES:
            return known
        return filters_again(self.as_prepared, best, known)


def is_explained(left: Statistics, otherwise: Statistics) -> bool:
    """Whether several machines leave noise alone, or next to nothing of what one machine leaves."""
    return left.at_the_floor or left.variance - 1.0 < NEXT_TO_NOTHING * (otherwise.variance - 1.0)


def _of_motion(filters: Sequence[SensorFilter]) -> tuple[SensorFilter, ...]:
    return tuple(f for f in filters if not f.of_noise)


def _simpler(these: Sequence[Fit], best: Fit) -> list[Fit]:
    """The explanations that fit best by fewer effects than the best one, of each number, and of single effects some."""
    closest = sorted(these, key=lambda f: f.cost)
    by_size = ([f for f in closest if len(f.added) == size] for size in range(1, len(best.added)))
    return [f for size, found in enumerate(by_size) for f in found[: SINGLE if size == 0 else 1]]
