"""Makes one bench trial: physics on a bench, then what its logger makes of it, and the truth about both."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from rwn.studies.trials.adapter import TASK
from rwn.studies.trials.aim import UnsuitableError, aim, refit
from rwn.studies.trials.bench import Noise, Recording
from rwn.studies.trials.bench_trials.answer import Findings, answer
from rwn.studies.trials.bench_trials.logger import Logger
from rwn.studies.trials.bench_trials.plan import BenchPlan, redealt
from rwn.studies.trials.bench_trials.quick_refit import QuickRefit
from rwn.studies.trials.bench_trials.rig import CURRENT, SPEED, Rig, Truth
from rwn.studies.trials.bench_trials.scene import draw_bench
from rwn.studies.trials.conceal import nominal_as
from rwn.studies.trials.effects import BACKGROUND, EFFECTS, Effect
from rwn.studies.trials.judges import JUDGES
from rwn.studies.trials.plan import SPLITS, split_of
from rwn.studies.trials.plant import Trace, Values
from rwn.studies.trials.refit import ENOUGH, Fit, fit_rival
from rwn.studies.trials.trial import ATTEMPTS, NEEDED, PATIENCE, Trial, must_move

Cast = list[tuple[Effect, Values]]

TOLERANCE = 0.25  # of a planned visibility; the one reached is in the answer
AGREEMENT = 0.5  # of the noise: what two judges of one law may differ by


def make_bench_trial(plan: BenchPlan) -> Trial:
    """The trial of `plan`; draws again until motor, bench and effects make it possible."""
    for attempt in range(ATTEMPTS):
        if attempt and attempt % PATIENCE == 0:
            plan = redealt(plan, attempt)
        stream = (SPLITS.index(split_of(plan.seed)), plan.seed, plan.index, attempt, 3)
        try:
            return _Composer(plan, stream).compose()
        except UnsuitableError:
            continue
    raise RuntimeError(f"{plan.name}: no bench found for {plan}")


class _Composer:
    def __init__(self, plan: BenchPlan, stream: tuple[int, ...]) -> None:
        self.plan, self.stream = plan, stream
        self.rng = np.random.default_rng(stream)
        self.bench = draw_bench(self.rng, stream, plan)
        self.scene = self.bench.scene
        self.quick = QuickRefit(self.scene)
        self.cast: Cast = []
        self.each: dict[str, float] = {}
        self.alone: tuple[list[Trace], Fit] | None = None  # recordings and refit of the last thing aimed

    def compose(self) -> Trial:
        plan, scene = self.plan, self.scene
        noise = self._aimed()
        plant = scene.plant(self.cast)
        train = scene.run(scene.train, plant)
        heldout = scene.run(scene.heldout, plant)
        must_move([*train, *heldout])
        fit = refit(scene, train, noise, self.quick(train, noise).nominal)
        self._all_needed(train, noise)
        nominal = nominal_as(plan.nominal, self.rng, scene.true, scene.uncertainty, fit.nominal)
        rivals = self._rivals(noise)
        truths = self._played(plant, [*train, *heldout], noise)
        logger = self._logger(truths[: len(train)], noise, plant)
        written = [logger.record(t, (*self.stream, k)) for k, t in enumerate(truths)]
        clean = [logger.without_noise().record(t, (*self.stream, k)) for k, t in enumerate(truths)]
        findings = Findings(
            plan=plan, bench=self.bench, cast=self.cast, each=self.each, noise=noise, fit=fit, nominal=nominal,
            heldout=heldout, plant=plant, rivals=rivals, written=written, clean=clean,
        )  # fmt: skip
        _readable(written)
        task: dict[str, Any] = {"heldout": plan.heldout_given}
        for each in self.bench.chain:
            task |= each.declared()
        notes = {TASK: json.dumps(task) + "\n"}
        return Trial(nominal, tuple(written[: len(train)]), tuple(written[len(train) :]), answer(findings), notes)

    def _aimed(self) -> Noise:
        """Sets the strength of everything that acts, each alone; the noise follows the first one where it may."""
        plan = self.plan
        noise, free = self.bench.noise, self.bench.noise_is_free
        wanted = [(EFFECTS[n], v) for n, v in zip(plan.effects, plan.visibilities, strict=True)]
        wanted += [(BACKGROUND[plan.background], plan.background_visibility)] if plan.background else []
        for effect, visibility in wanted:
            drawn = effect.draw(self.rng, self.scene.situation)
            aimed = aim(
                effect, drawn, visibility, self.scene, noise,
                noise_is_free=free, tolerance=TOLERANCE, refitted=self.quick,
            )  # fmt: skip
            noise, free = aimed.noise, False
            self.each[effect.name] = round(aimed.fit.visibility, 3)
            self.cast.append((effect, aimed.values))
            self.alone = (aimed.traces, aimed.fit)
        return noise

    def _all_needed(self, train: list[Trace], noise: Noise) -> None:
        """Without any one of several named effects the others, at their true values, leave something."""
        if len(self.plan.effects) < 2:
            return
        s = self.scene
        for left_out, _ in self.cast[: len(self.plan.effects)]:
            others: Values = {}
            for effect, values in self.cast:
                others |= effect.build(values, s.true) if effect is not left_out else {}
            if self.quick(train, noise, fixed=others).total < NEEDED:
                raise UnsuitableError(f"{left_out.name} is not needed")

    def _rivals(self, noise: Noise) -> dict[str, float]:
        """What named rivals of the only named effect, or of a background alone, leave of it in noise units."""
        plan, s = self.plan, self.scene
        if self.alone is None or len(plan.effects) > 1:
            return {}
        effect, values = self.cast[0]
        traces, near = self.alone
        if len(self.cast) > 1:
            traces = s.run(s.train, s.plant(self.cast[:1]))
            near = refit(s, traces, noise)
        rivals = [EFFECTS[name] for name in effect.rivals if EFFECTS[name].named]
        found = {
            rival.name: round(
                fit_rival(
                    rival, traces, centre=s.true, uncertainty=s.uncertainty, noise=noise, situation=s.situation,
                    near=near, known=values, rng=self.rng,
                ),
                4,
            )
            for rival in rivals
            if rival.suits(s.situation)
        }  # fmt: skip
        if not plan.effects and min(found.values(), default=np.inf) < ENOUGH:
            raise UnsuitableError("a named effect reproduces the unnamed one")
        return found

    def _played(self, plant: Values, own: Sequence[Trace], noise: Noise) -> list[Truth]:
        """Every experiment on the judge. A sensor that rounds does so after the noise, so the plant must not."""
        rig, judge = self.scene.setup, JUDGES[self.plan.judge]
        assert isinstance(rig, Rig)
        plant = {name: value for name, value in plant.items() if name != "speed_quantum"}
        truths = []
        for number, experiment in enumerate((*self.scene.train, *self.scene.heldout)):
            machine = plant
            for each in self.bench.chain:
                machine = each.machine(number, machine)
            if not judge.describes(machine):
                raise UnsuitableError(f"{judge.name} has no such machine")
            off = round(max(each.off(number) for each in self.bench.chain) * rig.rate)
            truths.append(rig.play(experiment, machine, judge, off))
            expected = own[number] if machine == plant else rig.run(experiment, machine)
            apart = float(np.sqrt(np.mean((truths[-1].trace().speed - expected.speed) ** 2)))
            if off == 0 and not apart <= AGREEMENT * noise.speed:
                raise UnsuitableError("the judges do not agree about this machine")
        return truths

    def _logger(self, train: Sequence[Truth], noise: Noise, plant: Values) -> Logger:
        def peak(column: int) -> float:
            return max(float(np.max(np.abs(truth.states[:, column]))) for truth in train)

        voltage = max(float(np.max(np.abs(truth.voltage))) for truth in train)
        return Logger(
            imperfections=self.bench.chain,
            noise=noise,
            signals=self.scene.setup.signals,
            peaks={"speed": peak(SPEED), "current": peak(CURRENT), "voltage": voltage},
            quantum=plant.get("speed_quantum", 0.0),
        )


def _readable(recordings: Sequence[Recording]) -> None:
    """Raises UnsuitableError where too few rows are left, or nothing moves in them."""
    for recording in recordings:
        columns = [recording.speed, *([recording.current] if recording.current is not None else [])]
        if recording.time.size < 300 or any(np.ptp(column) == 0.0 for column in columns):
            raise UnsuitableError("a recording says nothing")
