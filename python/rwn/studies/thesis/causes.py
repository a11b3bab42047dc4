"""Why a number of the thesis is not reproduced, in words: what was measured, where the tables of choices show it.

Kept apart from the experiments, so that a word can be mended without hours of trainings.
"""

from __future__ import annotations

from rwn.studies.thesis.experiment import Row

_CONTRADICTION = (
    "the thesis contradicts itself: one network (dyadic grid, 15 wavelets, mu 0.01, 10 000 iterations) has 0.0828 in "
    "Table 1 (momentum 0.4) and 0.0232 in Table 2 (momentum 0.6); with mu (1 - gamma) the two would be one number, "
    "with mu as printed they differ by 1.2. None of the choices tried brings both tables"
)
_TABLE_4 = (
    "the thesis contradicts itself: Table 2 has 0.0103 for the Gaussian derivative after 10 000 iterations, Table 4 "
    "0.0158 after 1000, so that it learns next to nothing in the last 9000; and from the dyadic grid the order of the "
    "wavelets is reversed under every choice tried, while from the heuristic start every error is 9 times the "
    "thesis's and more (choices)"
)
_WEIGHTS = (
    "the first weights are not said, nor whether (2.12) or (2.21), twice as steep, is descended: w in +-0.3 brings it "
    "out, and so does the steeper one (choices)"
)
_FIGURE_30 = (
    "the sampling of the signal is not said: from 20 to 2 ms it moves the error met while learning by 10, and leaves "
    "the tested one 500 times below the thesis's and more (choices)"
)
_BLACK_BOX = "what an iteration is, the start and the fraction are not said, and each moves the error by 10 or more"
_BILINEAR = _BLACK_BOX + "; 30 cycles in place of 10 000 bring both numbers of the bilinear model out (choices)"
_MEASURED = (
    "the error follows the levels of the friction, which the text does not give, and the fraction of the bound: with a "
    "larger one less is met while learning and more tested"
)
_STRUCTURED = (
    "the first weights and the fraction of the bound are not said: in 500 cycles w from 0.001 to 1 (fraction 0.1) "
    "moves it by 14 and more, the fraction from 0.01 to 0.5 by up to 44"
)
_SIZES = (
    _STRUCTURED + "; after 100 000 cycles from w in +-1 all of Tables 13 and 14 lie within 4 of the thesis's (choices)"
)

# where, how the case begins, the cause; the first that fits counts
CAUSES = (
    ("Table 1", "", _CONTRADICTION),
    (
        "Table 3",
        "LM",
        "how Levenberg-Marquardt starts is not said: from the dyadic grid every seed reaches less, from the heuristic "
        "start the thesis's lies within the range of the seeds",
    ),
    ("Table 4", "", _TABLE_4),
    ("Table 5", "heuristic, Nw 7", _WEIGHTS),
    (
        "Table 5",
        "dyadic-grid, Nw 7",
        "the domain, the first weights and which cost is descended are not said: [-0.5, 0.5]^2 brings it out, and so "
        "does w in +-0.3 with (2.21), twice as steep as (2.12) (choices)",
    ),
    (
        "Table 5",
        "heuristic, Nw 15",
        "the draw of the first weights decides, 4 of 20 are within 2 of the thesis's; 11 x 11 patterns, which are not "
        "said either, bring the median there (choices)",
    ),
    ("Table 6", "heuristic, mu 0.02", _WEIGHTS),
    (
        "Table 6",
        "dyadic-grid, mu 0.02",
        "the draw of the first weights decides, 10 of 20 are within 2 of the thesis's; 11 x 11 patterns, or descending "
        "(2.21), twice as steep as (2.12), bring the median there (choices)",
    ),
    ("Table 7", "LM", "the start decides by more than 100: the best seed is within 2 of the thesis's"),
    ("Table 8", "", "the start decides: see the range over the seeds"),
    ("Figure 30", "", _FIGURE_30),
    (
        "Table 9",
        "",
        "the error met while learning is that of following the signal and falls with the sampling time, which is not "
        "said; no sampling and no reading of the momentum brings one wavelet 25 times below the others (choices)",
    ),
    (
        "Figure 37",
        "",
        "how far the spiral reaches into the corners is not said, and decides the tested error (choices of Table 10)",
    ),
    *((f"Figure {number}", "", _BILINEAR) for number in (46, 49)),
    *((f"Figure {number}", "", _BLACK_BOX) for number in (51, 54)),
    ("Table 11", "", _MEASURED),
    ("Table 12", "", _MEASURED),
    ("Table 13", "", _SIZES),
    ("Table 14", "", _SIZES),
    (
        "Table 15",
        "morlet",
        "omega0, the first weights and the fraction are not said and move it from 1e-4 to 62: with omega0 5 "
        "abs(c/d) max abs(phi') soon reaches 1 from most starts, the bounds have no meaning from there on, nothing "
        "learns any more, and the error stays near that of the start; w in +-0.5 and in +-1 bring it out (choices)",
    ),
    ("Table 15", "", _STRUCTURED + " (choices)"),
    ("Table 16", "", _STRUCTURED + " (choices)"),
    (
        "Table 17",
        "",
        "a correction acts after 1/(1 - rho) = 216 samples, the rule's derivation lets it act at once",
    ),
    (
        "Table 19",
        "",
        "J, Kt and B scaled together hardly change the speed: one e-fold along that valley takes 5e6 cycles",
    ),
    (
        "Table 20",
        "J",
        "the error of J follows the fraction of the bound and where its maxima come from, which are not said",
    ),
    (
        "Table 20",
        "raw B",
        "v1 shares its slope with the network and acts as an observer gain: raw B is not determined by the data",
    ),
    ("Figure 104", "", "follows J and B, and so the fraction and the number of cycles"),
)


def cause(row: Row) -> str:
    """Why a row that speaks for a number of the thesis is not that number; of another row what its run has said."""
    fitting = (text for where, case, text in CAUSES if row.where == where and row.case.startswith(case))
    return next(fitting, "") if row.answer else row.reason
