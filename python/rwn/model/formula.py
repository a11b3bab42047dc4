"""Formulas of users: read with a short list of what is allowed, checked for units, made a postfix program.

Nothing is ever handed to `eval`. The core runs the program on dual numbers, `evaluate` on NumPy arrays.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from rwn import _core
from rwn.errors import InputError, closest, unrecognised
from rwn.recording import units

MAX_LENGTH = 2000

FUNCTIONS: dict[str, tuple[int, Callable[..., Any]]] = {
    "sin": (1, np.sin),
    "cos": (1, np.cos),
    "tan": (1, np.tan),
    "atan": (1, np.arctan),
    "tanh": (1, np.tanh),
    "exp": (1, np.exp),
    "log": (1, np.log),
    "sqrt": (1, np.sqrt),
    "abs": (1, np.abs),
    "sign": (1, np.sign),
    "min": (2, np.minimum),
    "max": (2, np.maximum),
    "mexican_hat": (1, lambda z: (1.0 - z * z) * np.exp(-0.5 * z * z)),
}
_OPERATORS: dict[type[ast.operator], tuple[str, Callable[[Any, Any], Any]]] = {
    ast.Add: ("add", lambda a, b: a + b),
    ast.Sub: ("subtract", lambda a, b: a - b),
    ast.Mult: ("multiply", lambda a, b: a * b),
    ast.Div: ("divide", lambda a, b: a / b),
    ast.Pow: ("power", lambda a, b: a**b),
}
_BINARY = dict(_OPERATORS.values())
_CONSTANTS = {"pi": float(np.pi)}


@dataclass(frozen=True)
class Instruction:
    """One step of the stack machine: push a number, push a named value, or apply `operation` to the top."""

    operation: str  # "number", "name", "negate", a key of _BINARY, or of FUNCTIONS
    number: float = 0.0
    name: str = ""


@dataclass(frozen=True, kw_only=True)
class Expression:
    """A formula in postfix form; `names` are the values that it needs, in the order of their first use."""

    text: str
    program: tuple[Instruction, ...]
    names: tuple[str, ...]

    def evaluate(self, values: Mapping[str, Any]) -> Any:
        """The value for `values` of each name: floats or arrays of one shape."""
        stack: list[Any] = []
        for step in self.program:
            if step.operation == "number":
                stack.append(np.float64(step.number))  # divides by zero as the core does
            elif step.operation == "name":
                stack.append(values[step.name])
            else:
                _apply(step.operation, stack)
        (result,) = stack
        return result


def _apply(operation: str, stack: list[Any]) -> None:
    if operation == "negate":
        stack.append(-stack.pop())
        return
    function = _BINARY[operation] if operation in _BINARY else FUNCTIONS[operation][1]
    arguments = stack[-_taken(operation) :]
    del stack[-len(arguments) :]
    stack.append(function(*arguments))


def parse(text: str, names: Mapping[str, str], *, where: object) -> Expression:
    """Read a formula over `names` (name -> SI unit); `^` is a power. Raises InputError."""
    if len(text) > MAX_LENGTH:
        raise _refused(f"the formula has {len(text)} characters", where, f"at most {MAX_LENGTH}")
    try:
        tree = ast.parse(text.replace("^", "**").strip(), mode="eval")
        program = tuple(_compile(tree.body, names, where))
    except InputError:
        raise
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise _refused(
            f"cannot read the formula '{text[:80]}'", where, "such as -k * speed * abs(speed)"
        ) from error
    if _depth(program) > _core.formula_depth:
        raise _refused(
            f"the formula holds {_depth(program)} values at once", where, f"at most {_core.formula_depth}"
        )
    used = tuple(dict.fromkeys(step.name for step in program if step.operation == "name"))
    return Expression(text=text, program=program, names=used)


def _compile(node: ast.expr, names: Mapping[str, str], where: object) -> Iterator[Instruction]:
    match node:
        case ast.Constant(value=int() | float() as value) if (
            not isinstance(value, bool) and abs(value) < 1e300
        ):
            yield Instruction("number", number=float(value))
        case ast.Name(id=name):
            yield _name(name, names, where)
        case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=operand):
            yield from _compile(operand, names, where)
            if isinstance(node.op, ast.USub):
                yield Instruction("negate")
        case ast.BinOp(left=left, op=operator, right=right) if type(operator) in _OPERATORS:
            yield from _compile(left, names, where)
            yield from _compile(right, names, where)
            yield Instruction(_OPERATORS[type(operator)][0])
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]):
            yield from _call(name, arguments, names, where)
        case _:
            shown = ast.unparse(node)[:60]
            raise _refused(
                f"'{shown}' is not allowed in a formula", where, "numbers, names, + - * / ^ and functions"
            )


def _depth(program: tuple[Instruction, ...]) -> int:
    """Most values that are on the stack at once."""
    depth = most = 0
    for step in program:
        depth += 1 - _taken(step.operation)
        most = max(most, depth)
    return most


def _taken(operation: str) -> int:
    """Values that an operation takes off the stack; it leaves one."""
    if operation in ("number", "name"):
        return 0
    return 2 if operation in _BINARY else FUNCTIONS[operation][0] if operation in FUNCTIONS else 1


def _name(name: str, names: Mapping[str, str], where: object) -> Instruction:
    if name in _CONSTANTS:
        return Instruction("number", number=_CONSTANTS[name])
    if name not in names:
        raise unrecognised("name", name, names, where=where)
    return Instruction("name", name=name)


def _call(
    name: str, arguments: list[ast.expr], names: Mapping[str, str], where: object
) -> Iterator[Instruction]:
    if name not in FUNCTIONS:
        raise unrecognised("function", name, FUNCTIONS, where=where)
    count = FUNCTIONS[name][0]
    if len(arguments) != count:
        raise _refused(f"{name} has {len(arguments)} arguments", where, f"{count}")
    for argument in arguments:
        yield from _compile(argument, names, where)
    yield Instruction(name)


def check_units(expression: Expression, names: Mapping[str, str], unit: str, *, where: object) -> None:
    """Raises InputError where a formula is not in `unit`, or its units clash: metres plus seconds, a sine of volts."""
    values = {name: units.sample(names[name], 1.1 + 0.3 * k) for k, name in enumerate(expression.names)}
    try:
        result = expression.evaluate(values)
        units.same_dimension(result, unit)
    except Exception as error:  # pint raises several kinds
        raise InputError(
            f"the units of '{expression.text[:80]}' do not work out ({units.clash(error)})",
            where=where,
            expected=f"a formula in {unit}",
            fix="give plain numbers in it their own parameter with a unit, or correct the units",
        ) from error


def _refused(what: str, where: object, expected: str) -> InputError:
    near = closest(what.split("'")[1], FUNCTIONS) if "'" in what else None
    fix = f"did you mean '{near}'?" if near else "see docs/own_effects.md"
    return InputError(what, where=where, expected=expected, fix=fix)
