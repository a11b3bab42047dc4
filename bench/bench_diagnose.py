"""Time of a whole diagnosis with every effect tried; at most 20 s for 20 000 samples on two cores is asked.

Makes blind trials of a development seed with 20 000 training samples each, five with a backlash, which none of these
has, and five that took longest before searches kept to a budget, and diagnoses them one after the other, without
held-out recordings, on two threads. Run on an idle machine; "stolen" is the share of the processor time asked for that
a virtual machine's host gave to others (/proc/stat). Beside the time on the wall stands that of the processor, which
other work on the machine lengthens less. Of several RUNS of each the quickest counts; --page writes the page:
python bench/bench_diagnose.py [COUNT [RUNS]] [--page docs/speed.md]
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np

import rwn
from page import Table, asked_for
from rwn.studies.trials import scene
from rwn.studies.trials.adapter import train_files
from rwn.studies.trials.plan import Plan, plans
from rwn.studies.trials.trial import make_trial
from rwn.studies.trials.trial_files import write_trial

SEED, COUNT, RUNS = 77, 20, 1
SAMPLES = (19_500, 20_500)
ASKED = 20.0  # [s]
BACKLASH = (
    Plan(seed=91, index=1, mode="offset", effects=("backlash",), visibility=10.0),
    Plan(seed=91, index=6, mode="offset", effects=("backlash",), visibility=30.0),
    Plan(seed=91, index=3, mode="plain", effects=("backlash",), visibility=30.0),
    Plan(seed=91, index=5, mode="double", effects=("backlash", "quadratic-drag"), visibility=10.0),
    Plan(seed=91, index=4, mode="double", effects=("backlash", "speed-sensor-lag"), visibility=10.0),
)
LONGEST = (  # 19 to 174 s; the last two are of test seeds that were scored before
    Plan(seed=209, index=0, mode="novel", effects=("slew-rate-limit",), visibility=10.0),
    Plan(seed=209, index=12, mode="novel", effects=("amplifier-compression",), visibility=4.0),
    Plan(seed=210, index=40, mode="double", effects=("cogging-torque", "sensor-quantization"), visibility=30.0),
    Plan(seed=10036, index=55, mode="novel", effects=("slew-rate-limit",), visibility=30.0),
    Plan(seed=10027, index=17, mode="double", effects=("backlash", "torque-ripple"), visibility=30.0),
)


def processor_times() -> tuple[float, float]:
    """Seconds, up to a factor, that all processors worked, and that their host kept them waiting; 0 where unknown."""
    stat = Path("/proc/stat")
    if not stat.exists():
        return 0.0, 0.0
    user, nice, system, _, _, hard, soft, stolen = map(float, stat.read_text().split()[1:9])
    return user + nice + system + hard + soft, stolen


def timed(recordings: list[rwn.Recording], model: rwn.Model) -> tuple[float, float, float, rwn.Diagnosis]:
    """Seconds of a diagnosis on the wall and of the processor, the share that was stolen, and what it found."""
    before, begin, work = processor_times(), time.perf_counter(), time.process_time()
    found = rwn.diagnose(recordings, model, jobs=2)
    seconds, work = time.perf_counter() - begin, time.process_time() - work
    worked, stolen = np.subtract(processor_times(), before)
    return seconds, work, stolen / max(worked + stolen, 1.0), found


def main() -> None:
    bench = asked_for("diagnose", __doc__, "count", "runs")
    count, runs = [*bench.counts, *(COUNT, RUNS)[len(bench.counts) :]]
    scene.TRAIN_ROWS = SAMPLES
    times, works, rows = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for plan in (*plans(SEED, count), *BACKLASH, *LONGEST):
            trial = make_trial(plan)
            place = Path(folder) / f"{plan.seed}-{plan.name}"
            write_trial(place, trial)
            model = rwn.read_model(place / "model.toml")
            recordings = [rwn.read_recording(f, layout=model.recording) for f in train_files(place)]
            seconds, work, stolen, found = min((timed(recordings, model) for _ in range(runs)), key=lambda run: run[0])
            times.append(seconds)
            works.append(work)
            names = " + ".join(e.name for e in found.effects) or found.verdict
            concealed = " + ".join(e["name"] for e in trial.answer["effects"]) or "nothing"
            samples = sum(map(len, recordings))
            rows.append((concealed, names, f"{samples}", f"{seconds:.1f}", f"{work:.1f}", f"{stolen:.0%}"))
            print(*rows[-1], sep="; ", flush=True)
    late = sum(t > ASKED for t in times)
    title = f"Whole diagnoses on two threads: {count} drawn, {len(BACKLASH)} with a backlash, {len(LONGEST)} long ones:"
    bench.show(
        Table(title, ("concealed", "found", "samples", "wall [s]", "processor [s]", "stolen"), rows),
        f"Median {np.median(times):.1f} s on the wall and {np.median(works):.1f} s of processor; longest "
        f"{max(times):.1f} and {max(works):.1f} s; {late} of {len(times)} over {ASKED:.0f} s on the wall.",
    )


if __name__ == "__main__":
    main()
