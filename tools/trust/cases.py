"""Hostile inputs of `rwn`, by class: what is written into a folder, and the command line that is run there.

A case that no user could mean is marked `refuse`: it must end with 2 (or 3) and one line. A damaged file may by chance
still be a good one, so that its cases are not marked: they must end with 0, 2 or 3, and what they write must be finite.
"""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

MODEL = """[motor]
kind = "dc"
resistance = 0.8
inductance = 1.5e-3
torque_constant = 0.1
back_emf_constant = 0.1
inertia = 3e-4
viscous_friction = 7e-5
[uncertainty]
inertia = 0.1
"""
OWN = """[own_effects.brake]
term = "torque"
equation = "-k * {}"
meaning = "a brake"
source = "none"
parameters.k = { unit = "N m", lower = 0.0, upper = 1.0, start = 0.01, strength = true, meaning = "its torque" }
parameters.c = { unit = "rad/s", lower = 1.0, upper = 99.0, start = 10.0, meaning = "its corner" }
[effects.brake]
k = 0.01
c = 10.0
"""
SIMULATE = ("simulate", "motor.toml", "--input", "a.csv", "--out", "out.csv")
MUTATIONS = (b"\0", b"\xff", b"\n", b",", b";", b"\t", b'"', b"[", b"]", b"-", b"1e999", b"nan", b"#", b"\x1b[2J")


@dataclass(frozen=True, kw_only=True)
class Case:
    """One input: `files` name -> content, beside the good a.csv, b.csv and motor.toml; `refuse`: it must not pass."""

    kind: str
    what: str
    command: tuple[str, ...] = SIMULATE
    files: dict[str, bytes] = field(default_factory=dict)
    links: dict[str, str] = field(default_factory=dict)  # name -> where to; "|": a pipe
    refuse: bool = True


def cases(count: int, seed: int, good: Path) -> Iterator[Case]:
    """The table of cases by hand, then `count` damaged ones; `good`: a folder with good files of every format."""
    yield from _tables()
    yield from _recordings()
    yield from _models()
    yield from layouts()
    yield from _formulas()
    yield from _places()
    yield from _commands()
    yield from _damaged(count, random.Random(seed), good)


def _tables() -> Iterator[Case]:
    head, row = "time [s],voltage [V],speed [rad/s]\n", "{},1.0,2.0\n"
    rows = "".join(row.format(k * 1e-3) for k in range(200))
    texts = {
        "empty": "", "header alone": head, "one row": head + "0,1,2\n", "no numbers": head + "a,b,c\n" * 99,
        "time runs back": head + "".join(row.format(-k) for k in range(200)),
        "time stands still": head + row.format(0) * 200, "a cell left out": head + rows.replace("0.05,", ","),
        "a row too short": head + rows + "0.3,1\n", "a row too long": head + rows + "0.3,1,2,3\n",
        "nan": head + rows.replace("0.05,1.0", "0.05,nan"), "inf": head + rows.replace("0.05,1.0", "0.05,inf"),
        "1e30": head + rows.replace("0.05,1.0", "0.05,1e30"), "hex": head + rows.replace("0.05,1.0", "0.05,0x1p3"),
        "underscores": head + rows.replace("0.05,1.0", "0.05,1_000"), "a quote left open": head + '"' + rows,
        "two of a name": head.replace("speed", "voltage") + rows, "no unit": head.replace(" [V]", "") + rows,
        "no such unit": head.replace("[V]", "[bananas]") + rows, "unit of another kind": head.replace("[V]", "[m]") + rows,
        "unit of no angle": head.replace("rad/s", "Hz") + rows, "a formula as unit": head.replace("[V]", "[__import__]") + rows,
        "near miss": head.replace("speed", "speeed") + rows, "no signal": "a,b,c\n" + rows,
        "open bracket": head.replace("[V]", "[V") + rows, "a gap": head + rows + "9.0,1,2\n",
        "thousands": head + rows.replace("0.05,1.0", '0.05,"1,000.0"'), "a million columns": ",".join(["x"] * 10**6) + "\n",
        "a line of 2 MB": head + "1" * 2**21 + ",1,2\n", "script": head + rows.replace("0.05,1.0", "0.05,<script>"),
    }  # fmt: skip
    for what, text in texts.items():
        yield Case(kind="CSV", what=what, files={"a.csv": text.encode()})
    for encoding in ("utf-16", "utf-32", "utf-8-sig", "cp037"):
        refuse = encoding in ("utf-32", "cp037")
        yield Case(kind="CSV", what=encoding, files={"a.csv": (head + rows).encode(encoding)}, refuse=refuse)


def _recordings() -> Iterator[Case]:
    for ending in ("mat", "npz", "npy", "parquet", "xlsx", "xls", "ods", "mcap", "wpilog", "json", "tdms", "mf4", "doc"):
        command = ("simulate", "motor.toml", "--input", f"x.{ending}", "--out", "out.csv")
        for what, content in {
            "empty": b"", "zeros": bytes(4096), "text": b"time,voltage\n1,2\n" * 99, "a zip": b"PK\3\4" + bytes(99),
            "ones": b"\xff" * 4096, "its first letters": {"mat": b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM"}.get(ending, b"{"),
        }.items():  # fmt: skip
            yield Case(kind="other formats", what=f"{what} as .{ending}", command=command, files={f"x.{ending}": content})


def _models() -> Iterator[Case]:
    for name in ("resistance", "inductance", "torque_constant", "back_emf_constant", "inertia", "viscous_friction"):
        line = next(text for text in MODEL.splitlines() if text.startswith(name))
        for value in ("-1", "nan", "inf", "1e300", '"1 parsec"', '"x"', "true", "[1]", "8" * 401, '"1e999 ohm"', "", "{}"):
            text = MODEL.replace(line, f"{name} = {value}")
            yield Case(kind="model file", what=f"{name} = {value[:20]}", files={"motor.toml": text.encode()})
        without = {"motor.toml": MODEL.replace(line, "").encode()}
        told = name in ("torque_constant", "back_emf_constant")  # by the other one
        yield Case(kind="model file", what=f"no {name}", files=without, refuse=not told)
    extra = {
        "kind = 'ac'": MODEL.replace('"dc"', '"ac"'), "no kind": MODEL.replace('kind = "dc"', ""), "empty": "",
        "no motor": "[motr]\n", "deep lists": MODEL + "x = " + "[" * 900 + "]" * 900, "open string": MODEL + 'x = "',
        "twice": MODEL + MODEL, "uncertainty of nothing": MODEL + "speed = 0.1\n", "uncertainty -1": MODEL.replace("0.1\n", "-1\n", 1),
        "unknown table": MODEL + "[motors]\nx = 1\n", "unknown effect": MODEL + "[effects.frictoin]\nx = 1\n",
        "effect of no value": MODEL + "[effects.coulomb-friction]\n", "effect -1": MODEL + "[effects.coulomb-friction]\ncoulomb_torque = -1\n",
        "effect of 1e9 N m": MODEL + "[effects.constant-load]\ntorque = 1e9\n",
        "profile": MODEL + '[recording]\nprofile = "x"\n', "decimate 0": MODEL + "[recording]\ndecimate = 0\n",
        "sample time -1": MODEL + "[recording]\nsample_time = -1\n", "from after to": MODEL + "[recording]\nfrom = 2\nto = 1\n",
        "scale 0": MODEL + '[recording]\ncolumns.speed = { source = "speed", scale = 0 }\n',
        "source of nothing": MODEL + '[recording]\ncolumns.speed = { source = "x", unit = "rpm" }\n',
        "unit against header": MODEL + '[recording]\ncolumns.speed = { source = "speed", unit = "rpm" }\n',
        "a law that is none": MODEL + '[recording]\nintersample = "x"\n', "a delay of text": MODEL + '[recording]\ndelays.speed = "x"\n',
        "escape codes": MODEL + '"\\u001b[2J" = 1\n', "a pendulum without mass": MODEL + "[load.pendulum]\nlength = 1\n",
        "order of 401 digits": '[motor]\nkind = "lti"\norder = ' + "8" * 401, "a recording": "time,voltage\n" + "1,2\n" * 99,
    }  # fmt: skip
    for what, text in extra.items():
        yield Case(kind="model file", what=what, files={"motor.toml": text.encode()})
    unstable = '[motor]\nkind = "lti"\norder = 1\nb0 = 300\na0 = -40000\n[uncertainty]\nb0 = 3\na0 = 3\n'
    command = ("diagnose", "a.csv", "--model", "motor.toml", "--out", "out")
    yield Case(kind="model file", what="unstable", command=command, files={"motor.toml": unstable.encode()}, refuse=False)


def layouts() -> Iterator[Case]:
    """Every number under [recording], in a model that is fitted: which of those below a user may mean."""
    meant: dict[str, tuple[str, ...]] = {
        "sample_time": ("6",), "initial_samples": ("6",), "from": ("-5",), "to": ("6",), "decimate": (),
        "delays.speed": (), "filters.speed": (), "delays.current": ("-5", "6"),  # there is no current
        "filters.current": ("6",), "columns.speed.scale": ("-5", "6"),
    }  # fmt: skip
    for key, good in meant.items():
        for number in ("8" * 401, str(2**63), "1e21", "-5", "6", "1e300"):
            files = {"motor.toml": (MODEL + f"[recording]\n{key} = {number}\n").encode()}
            for command in (("identify", "a.csv", "--model", "motor.toml", "--out", "f.toml"), ("check", "a.csv", "--model", "motor.toml")):
                what = f"{command[0]}, {key} = {number[:20]}"
                yield Case(kind="model file", what=what, command=command, files=files, refuse=number not in good)


def _formulas() -> Iterator[Case]:
    wrong = (
        "", "(", ")", "speed speed", "speed +", "2 ** speed", "speed[0]", "speed.real", "lambda: 1", "__import__('os')",
        "(x := 1)", "f'{speed}'", "'text'", "[1]", "{1}", "speed if 1 else 2", "not speed", "speed and 1", "1 < 2 < 3",
        "print(speed)", "open('x')", "exec('1')", "speeed", "sin()", "sin(1, 2)", "sin(speed, *a)", "sin(x=1)", "1j * speed",
        "speed ^ 2", "speed // 2", "speed % 2", "speed @ 2", "~speed", "True", "None", "...", "await speed", "yield 1",
        "k", "k * k", "speed + time", "speed + 1", "exp(speed)", "(" * 500 + "speed" + ")" * 500, "-" * 5000 + "1",
        "+".join(["1"] * 5000), "1e999", "9" * 5000, "\x1b[2J", "\u202espeed", "speed; 1", "speed # x", "import os",
    )  # fmt: skip
    for formula in wrong:
        model = MODEL + OWN.replace("{}", json.dumps(formula)[1:-1], 1)
        yield Case(kind="formula", what=ascii(formula[:40]), files={"motor.toml": model.encode()})


def _places() -> Iterator[Case]:
    for out in ("a.csv", "motor.toml", "/dev/null", "/dev/full", "folder", "dangling", "loop", "a.csv/x", "new/../a.csv", "pipe"):
        links = {"dangling": "nowhere", "loop": "loop", "pipe": "|"}
        command = ("simulate", "motor.toml", "--input", "a.csv", "--out", out, "--overwrite")
        yield Case(kind="place of output", what=f"simulate --out {out}", command=command, links=links, files={"folder/x": b""})
        command = ("identify", "a.csv", "--model", "motor.toml", "--out", out, "--overwrite")
        yield Case(kind="place of output", what=f"identify --out {out}", command=command, links=links, files={"folder/x": b""})
        if out not in ("folder", "new/../a.csv"):
            command = ("diagnose", "a.csv", "--model", "motor.toml", "--out", out, "--overwrite")
            yield Case(kind="place of output", what=f"diagnose --out {out}", command=command, links=links)
    for given in ("|", "loop", "/dev/zero", "/dev/urandom", "nowhere", "folder", "/proc/self/mem"):
        for name in ("a.csv", "motor.toml", "old/diagnosis.json", "old/curves.json", "old/corrected.toml"):
            of_result = name.startswith("old")
            command = ("report", "old", "--out", "r.html") if of_result else SIMULATE
            link = "loop" if given == "loop" else given
            files = {"folder/x": b""} | ({"old/diagnosis.json": b"{}"} if of_result and "diagnosis" not in name else {})
            links = {name: link} | ({"loop": "loop"} if given == "loop" else {})
            yield Case(kind="place of input", what=f"{name} -> {given}", command=command, files=files, links=links)


def _commands() -> Iterator[Case]:
    diagnose = ("diagnose", "a.csv", "--model", "motor.toml", "--out", "out")
    for rest in (
        ("--seed", "-1"), ("--seed", "x"), ("--jobs", "0"), ("--jobs", "x"), ("--heldout", "a.csv"), ("--heldout", "nowhere"),
        ("--heldout=b.csv", "c.csv"), ("--heldout", "b.csv", "c.csv"), ("--profile", "x"), ("--model",), ("--x",),
    ):  # fmt: skip
        yield Case(kind="command line", what=" ".join(("diagnose", *rest)), command=(*diagnose, *rest))
    for command in (
        ("identify", "a.csv", "a.csv", "--model", "motor.toml"), ("effects", "xyzzy"), ("effects", "--model", "a.csv"),
        ("report", "nowhere", "--out", "r.html"), ("report", ".", "--out", "r.html"), ("report", ".", ".", "--out", "r.html"),
        ("report", ".", "--compare", "--out", "r.html"), ("check", "nowhere", "--model", "motor.toml"), ("evidence", "xyzzy"),
        ("evidence", "--data", "nowhere", "--out", "ev"), ("thesis", "run"), ("thesis", "run", "--table", "99"),
        ("thesis", "run", "--figure", "-1"), ("thesis", "check", "--out", "nowhere"), ("thesis", "check", "--archive", "a.csv"),
        ("thesis", "real-machine", "nowhere"), ("trials", "run", "nowhere"), ("trials", "run", "."), ("trials", "score", "."),
        ("trials", "make", "--seed", "-1", "--count", "1", "--out", "t"), ("trials", "make", "--seed", "1", "--count", "0", "--out", "t"),
        ("trials", "make", "--seed", "1", "--count", "1", "--out", "a.csv"), ("trials", "spoil", ".", "--out", "t"),
        ("trials", "make", "--seed", "1", "--count", "1", "--out", "t", "--split", "test"), ("trials", "calibrate", "."),
        ("xyzzy",), ("diagnose",), ("simulate",), ("report",), ("demo", "--out", "a.csv"), ("check", "a.csv"),
    ):  # fmt: skip
        yield Case(kind="command line", what=" ".join(command), command=command)


def _damaged(count: int, draw: random.Random, good: Path) -> Iterator[Case]:
    """Good files with bytes changed, cut, doubled or exchanged."""
    files = sorted(path for path in good.rglob("*") if path.is_file())
    for k in range(count):
        path = files[k % len(files)]
        name, content = str(path.relative_to(good)), damage(path.read_bytes(), draw)
        command: tuple[str, ...]
        if name.startswith("trials/"):
            command = ("trials", "score", "trials")
        elif name.startswith("result/"):
            command = ("report", "result", "--out", "r.html")
        elif name.endswith(".toml"):
            command = ("simulate", name, "--input", "a.csv", "--out", "out.csv")
        else:
            part = "#slow-forward" if name.endswith(".json") else ""
            command = ("simulate", "motor.toml", "--input", name + part, "--out", "out.csv")
        kind = "damaged " + name.split("/")[0] if "/" in name else f"damaged .{name.rsplit('.', 1)[1]}"
        yield Case(kind=kind, what=f"{name}, {k}", command=command, files={name: content}, refuse=False)


def damage(content: bytes, draw: random.Random) -> bytes:
    text = bytearray(content)
    for _ in range(draw.randint(1, 4)):
        at = draw.randrange(len(text) + 1)
        match draw.randrange(6):
            case 0:
                text[at : at + 1] = bytes([draw.randrange(256)])
            case 1:
                text[at:at] = draw.choice(MUTATIONS)
            case 2:
                del text[at : at + draw.randint(1, 20)]
            case 3:
                text[at:at] = text[at : at + draw.randint(1, 200)]
            case 4:
                del text[at:]
            case _:
                to = draw.randrange(len(text) + 1)
                text[at : at + 8], text[to : to + 8] = text[to : to + 8], text[at : at + 8]
    return bytes(text)
