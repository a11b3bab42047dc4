"""How recordings were made, as the best explanation of them shows it: filters of the sensors, levels by the file."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rwn.fit.fit import Fit
from rwn.fit.problem import Problem
from rwn.fit.residuals import statistics
from rwn.measurement.filter_colour import SensorFilter
from rwn.measurement.known_filters import filtered
from rwn.measurement.levels import Level, all_levels, can_differ, friction, with_levels
from rwn.measurement.sensor_filter import filters_again, sensor_filters, shown_in_noise
from rwn.name.uneven import uneven_beside
from rwn.parallel import side_by_side

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

    def otherwise(self, problem: Problem, best: Fit, *, completely: bool) -> Measurement | None:
        """The measurement that the best explanation of `problem` shows; None: this one.

        `completely`: whether all is asked that several effects at once may show, not only what single ones do.
        """
        filters = self._filters(problem, best, completely)
        if filters != self.filters:
            return replace(self, filters=filters, changes=self.changes + bool(self.filters))
        level = self._level(problem, best) if completely else None
        if level is None:
            return None
        supposed = self.supposed or level.lasting
        return replace(self, as_prepared=with_levels(self.as_prepared, level), supposed=supposed)

    def in_noise(self, problem: Problem, best: Fit) -> Measurement | None:
        """The measurement with filters that the noise itself shows beside an explanation that may lack effects."""
        if self.filters or problem.drive.coefficients or not shown_in_noise(problem, best):
            return None
        filters = sensor_filters(problem, best)
        return replace(self, filters=filters) if filters else None

    def _level(self, problem: Problem, best: Fit) -> Level | None:
        """What differs from recording to recording most certainly, of what is not known to do so.

        Physics that is missing makes the numbers of a machine differ too: those are asked only where more than noise is
        left, and held to be several machines' only where that leaves noise alone.
        """
        done = statistics(problem, best).at_the_floor
        asked = [friction(problem)] if done else all_levels(problem)
        asked = [level for level in asked if can_differ(problem, level) and not (level.lasting and self.of_one_machine)]
        tried = side_by_side(lambda level: (level, uneven_beside(problem, best, level)), asked)
        decisive = [row for row in tried if row[1].is_decisive]
        return max(decisive, key=lambda row: row[1].log_odds)[0] if decisive else None

    def _filters(self, problem: Problem, best: Fit, completely: bool) -> tuple[SensorFilter, ...]:
        if problem.drive.coefficients:
            return self.filters
        if not self.filters:
            return sensor_filters(problem, best)
        if not completely or self.changes == CHANGES:
            return self.filters
        return filters_again(self.as_prepared, best, self.filters)
