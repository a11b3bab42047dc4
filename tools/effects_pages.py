"""Writes effects.md and a page for each effect from rwn's own table; mkdocs runs it (see mkdocs.yml)."""

from __future__ import annotations

from collections.abc import Iterator

from rwn.model.vocabulary import Effect, Parameter, table


def overview() -> str:
    """Every effect that has a name, by the equation that it belongs to."""
    lines = [
        "# Effects",
        "",
        f"The {len(table())} effects that rwn can name, as `rwn effects` prints them. This page and those that it",
        "leads to are made from the table that the simulation is compiled from.",
    ]
    for equation in dict.fromkeys(effect.mismatch for effect in table().values()):
        lines += ["", f"## {equation.capitalize()}", "", "| effect | meaning | equation |", "|---|---|---|"]
        lines += [
            f"| [{e.name}](effects/{e.name}.md) | {cell(e.meaning)} | `{cell(e.equation)}` |"
            for e in table().values()
            if e.mismatch == equation
        ]
    return "\n".join(lines) + "\n"


def page(effect: Effect) -> str:
    """What one effect is: equation, parameters with their units and bounds, and how a model file holds it."""
    lines = [f"# {effect.name}", "", f"{effect.meaning[:1].upper()}{effect.meaning[1:]}.", ""]
    lines += [f"    {effect.equation}", ""]
    lines += [f"It belongs to the {effect.mismatch} equation and acts on: {effect.site}.", ""]
    lines += ["| parameter | unit | meaning | least | most | in units of |", "|---|---|---|---|---|---|"]
    lines += [row(p) for p in effect.parameters]
    lines += ["", "In a model file:", "", "```toml", f"[effects.{effect.name}]"]
    lines += [f"{p.name} = ...  # {p.unit or 'a pure number'}" for p in effect.parameters]
    if effect.further:
        lines += ["# a further line, where there is one, and so on to line " + str(1 + effect.further[-1].line)]
        lines += [f"{p.name} = ...  # {p.unit or 'a pure number'}" for p in effect.further if p.line == 1]
    return "\n".join([*lines, "```", "", f"Source: {effect.source}.", "", "[All effects](../effects.md)"]) + "\n"


def row(p: Parameter) -> str:
    """One line of the table of parameters."""
    scale = f"{cell(p.scale.words)} of the drive" if p.scale.powers else "1"
    if p.scale.powers and p.scale.factor != 1.0:
        scale = f"{p.scale.factor:g} {scale}"
    return f"| `{p.name}` | {cell(p.unit) or '-'} | {cell(p.meaning)} | {p.lower:g} | {p.upper:g} | {scale} |"


def cell(text: str) -> str:
    """Text that does not end a cell of a table."""
    return text.replace("|", "\\|")


def pages() -> Iterator[tuple[str, str]]:
    """Path and text of every page."""
    yield "effects.md", overview()
    for effect in table().values():
        yield f"effects/{effect.name}.md", page(effect)


if __name__ == "<run_path>":  # as mkdocs-gen-files runs it
    import mkdocs_gen_files

    for path, text in pages():
        with mkdocs_gen_files.open(path, "w") as file:
            file.write(text)
