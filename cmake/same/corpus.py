"""The corpus: made devices and measurements, and what is done with them. Chance chooses both, the same always: a number of a
kind is one case, whatever other numbers and kinds do."""

import zlib

from case import Case, Step, step_of
from made import Draw, device, family, laboratory_cell, law_of, matrix, module, months

SMALL = "--folds 0 --no-individual-fits --iterations 20 --population 15"

# How strong a hidden effect is: its parameters, their ranges, and the unit of the range where that is the device's: I the
# photocurrent, S that by 1 V of a cell, R and R1 the inverse by all cells, D the current of a diode with n = 2 at open circuit.
EFFECTS = {
    "second_diode": {"Is2": (0.05, 1, "D")}, "nonohmic_shunt": {"k": (0.05, 0.5, "I"), "m": (1.5, 4)},
    "collection": {"chi": (0.003, 0.05)}, "photoshunt": {"Gph": (0.02, 0.3, "S")},
    "back_contact": {"1/Ib": (2, 50, "1/I"), "nb": (1, 4)}, "rs_current": {"Rs1": (-0.02, 0.05, "R1")},
    "distributed_rs": {"Rlat": (0.02, 0.3, "R")}, "shading": {"d": (0.05, 0.8), "w": (0.1, 0.67)},
    "mismatch": {"d": (0.02, 0.3), "w": (0.05, 0.5)},
    "substrings": {"d1": (0.1, 0.6), "w1": (0.3, 0.34), "d2": (0.05, 0.8), "w2": (0.3, 0.34)},
    "covered_edge": {"d1": (0.1, 0.7), "c1": (0.1, 0.9)}, "weak_cell": {"d": (0.1, 0.6)},
    "dim_cells": {"d1": (0.05, 0.5), "d2": (0.05, 0.5)}, "scatter": {"s": (0.01, 0.06)},
    "leaky_cell": {"g": (0.5, 20, "I")}, "graded_shunt": {"g": (0.5, 10, "I"), "s": (0.5, 6)},
    "bypass_open": {"d": (0.1, 0.6), "w": (0.3, 0.34)}, "open_substring": {"w": (0.3, 0.34)}, "drift": {"d": (-0.05, 0.05)},
    "irr_step": {"s": (-0.1, 0.1), "x0": (-0.3, 0.3)}, "transient": {"a": (-0.2, 0.3), "c": (-0.3, 0.3), "w": (0.02, 0.1)},
    "temp_drift": {"r": (-5, 5)}, "clip": {"Ic": (0.7, 0.98, "I")}, "range_switch": {"g": (-0.05, 0.05), "Ir": (0.1, 0.8, "I")},
    "current_offset": {"c": (-0.02, 0.02, "I")}, "voltage_offset": {"c": (-0.01, 0.01)},
}
OF_A_MODULE = {"shading", "mismatch", "substrings", "covered_edge", "weak_cell", "dim_cells", "scatter", "leaky_cell", "graded_shunt",
               "bypass_open", "open_substring"}
OF_SEVERAL_LIGHTS = {"photoshunt", "voltage_offset", "current_offset"}  # one lit curve does not show them
OF_ONE_LIGHT = {"clip", "range_switch"}


def _words(text):
    return text.split()


def _effect(draw, name, made):
    unit = {"I": made["Iph"], "1/I": 1 / made["Iph"], "S": made["Iph"] / made["cells"], "R": made["cells"] / made["Iph"],
            "R1": made["cells"] / made["Iph"] ** 2, "D": made["Iph"] * (made["Is"] / made["Iph"]) ** (made["n"] / 2), "": 1}
    return f"{name}:" + ",".join(f"{symbol}={draw.between(low, high) * unit[''.join(of)]:.4g}"
                                 for symbol, (low, high, *of) in EFFECTS[name].items())


def _values(made, **more):
    values = {"Iph": made["Iph"], "Is1": made["Is"], "n1": made["n"], "Rs": made["Rs"], "Rsh": made["Rsh"], **more}
    return [word for symbol, value in values.items() for word in ("--set", f"{symbol}={value:.6g}")]


def _simulated(made, *more, **values):
    return Step(("simulate", *_values(made, **values), "--cells", str(made["cells"]), "--temperature-C", f"{made['celsius']:.4g}",
                 *map(str, more)))


def _polish(draw, model):
    """How a fit weighs and judges; what excludes each other is not drawn together."""
    which = draw.weighed(plain=54, loss=20, noise=15, errors=4, raw=3, floor=1)
    if which == "loss":
        return [f"--loss={draw.of('huber', 'cauchy')}", *([f"--loss-scale={draw.between(1.5, 5):.3g}"] if draw.often(0.4) else [])]
    if which == "raw" and model != "auto":
        return ["--no-polish"]
    if which == "floor" and model == "sd":
        return ["--floor"]
    return {"noise": ["--noise", "field"], "errors": ["--noise", "errors.json"]}.get(which, [])


def _fit_words(draw, made, model):
    """The rest of a fit's arguments."""
    words = ["--model", model] if model != "sd" or draw.often(0.3) else []
    polish = _polish(draw, model)
    if draw.often(0.25) and "--noise" not in polish:
        words += ["--objective", "measured-current"]
    words += polish
    words += {"default": [], "symmetric": ["--intervals", "symmetric"], "none": ["--intervals", "none"],
              "profile": ["--intervals", "profile"]}[draw.weighed(default=40, symmetric=30, none=20, profile=10)]
    if "--floor" not in words:
        bounds = draw.weighed(physical=80, wide=12, box=8)
        words += {"wide": ["--bounds", "wide"], "box": ["--bounds", "box.json"]}.get(bounds, [])
    if draw.often(0.1) and model == "sd":
        words += [draw.of(f"--fix=n1={made['n']:.3g}", f"--bound=n1=1:{made['n'] + 0.4:.3g}", f"--bound=Rs=0:{2 * made['Rs']:.4g}",
                          f"--fix=Rsh={made['Rsh']:.4g}")]
    if model == "dd" and draw.often(0.3):
        words += ["--fix", "n2=2"]
    if draw.often(0.12):
        words += ["--algorithm", draw.of("lo", "lo+mblss", "lo+dmlss", "mlo+vector", "mlo+shape", "random", "de")]
    if draw.often(0.15):
        words += _words(draw.of(f"--seed {draw.whole(1, 99)}", f"--run {draw.whole(1, 9)}", f"--population {draw.whole(6, 40)}",
                                f"--iterations {draw.whole(5, 60)}", "--elites 2", "--constants literature"))
    return words


def fits(draw):
    """One curve of one device, and a fit."""
    cells = draw.of(1, 1, 1, draw.whole(2, 12), 36, 60, 72, draw.whole(13, 144), 144)
    current = draw.log(1e-3, 0.2) if cells == 1 and draw.often(0.5) else draw.log(0.5, 15)
    made = device(draw, cells, current, voltage=(0.48, 0.75) if draw.often(0.8) else (0.75, 1.15), n=(1.0, 2.0))
    real, model = draw.weighed(sd=70, dd=22, td=8), draw.weighed(sd=62, dd=15, td=8, auto=15)
    values = {}
    if real != "sd":
        values.update(Is2=made["Is"] ** (made["n"] / 2) * draw.log(0.1, 3) * made["Iph"] ** (1 - made["n"] / 2), n2=2)
    if real == "td":
        values.update(Is3=made["Is"] * draw.log(0.05, 1), n3=draw.between(1.0, 1.4))
    noise = draw.log(2e-5, 1e-2) * made["Iph"]
    more = ["--model", real] if real != "sd" else []
    span = f"{-0.1 * cells:.4g}:{0.85 * cells:.4g}"
    more += ["--voltages", f"{span}:{draw.whole(15, 120)}"] if draw.often(0.15) else ["--points", draw.whole(12, 160)]
    more += ["--noise-relative", f"{draw.log(1e-4, 3e-3):.3g}"] if draw.often(0.2) else []
    if draw.often(0.02):
        real, values, made["Iph"] = "sd", {}, 0.0  # a dark curve
        more = ["--voltages", f"0:{0.8 * cells:.4g}:40"]
    words = _fit_words(draw, made, model)
    if draw.often(0.08) and model != "auto" and not {"--floor", "--no-polish", "measured-current"} & set(words):
        name = draw.of("nonohmic_shunt", "collection", "rs_current", "second_diode", "irr_step", *(["mismatch"] if cells > 12 else []))
        words += ["--with", name]
        more += ["--with", _effect(draw, name, made)] if draw.often(0.5) else []
    if draw.often(0.04):
        words += ["--html", "fit.html", "--plot", "fit.svg"]
    given = [("errors.json", f'{{"current_noise_A": {noise:.4g}, "voltage_noise_V": {cells * 1e-4:.4g}, '
                             f'"path_of_isc": {draw.log(1e-4, 3e-3):.3g}}}\n'),
             ("box.json", f'{{"Iph": [0, {2 * current:.4g}], "Is": [0, {max(1e-5, 100 * made["Is"]):.4g}], "n": [1, 2.5], '
                          f'"Rs": [0, {5 * made["Rs"]:.4g}], "Rsh": [0, {10 * made["Rsh"]:.4g}]}}\n')]
    made_step = _simulated(made, *more, "--noise-A", f"{noise:.4g}", "--seed", draw.whole(0, 9999), "--out", "curve.csv", **values)
    step = Step(("fit", "curve.csv", *words, "--json", "fit.json", "--csv", "fit.csv"))
    return (made_step, step), tuple(item for item in given if item[0] in words)


def _family_words(draw, made, law, where, ids):
    """The arguments of a family's fit beside its law; what the law or the data exclude is not drawn."""
    of_law = law in ("desoto", "pvsyst")
    files = {"pvsyst": ["--pan", "family.PAN"], "cec": ["--sam", "family_sam.csv"], "desoto": ["--pvlib", "family_pvlib.json"]}
    words = _words(SMALL) if draw.often(0.75) else _words("--folds 2 --iterations 20 --population 15")
    written = files.get(law, []) if draw.often(0.2) else []  # of one diode and the law's own shunt
    words += ["--model", "dd"] if of_law and not written and draw.often(0.15) else []
    shunts = ("inverse", "constant") if law == "desoto" else ("constant", "exponential")
    words += ["--shunt", draw.of(*shunts)] if of_law and not written and draw.often(0.2) else []
    words += ["--recombination"] if law == "pvsyst" and draw.often(0.15) else []
    words += ["--weights", draw.of("auto", "equal", "isc")] if where != "matrix" and draw.often(0.25) else []
    words += ["--residuals", draw.of("auto", "key-points")] if draw.often(0.15) else []
    words += ["--key-point-errors", draw.of("voc=0.2%", "isc=0.5%", "vmp=1%,pmp=0.5%")] if where == "matrix" and draw.often(0.3) else []
    words += ["--free", draw.of("EgRef", "dEgdT")] if law == "desoto" and draw.often(0.1) else []
    ideality = f"--fix={'n' if law == 'desoto' else 'gamma_ref'}={made['n']:.3g}"
    words += [draw.of(ideality, "--bound=Rs=0:0.6")] if of_law and draw.often(0.12) else []
    if where != "matrix" and draw.often(0.2):
        words += draw.of(["--irradiance-offset"], ["--temperature-offset"], ["--irradiance-offset", "--temperature-offset"])
    if draw.often(0.2):
        words += _words(draw.of("--irradiance-accuracy 2%", "--temperature-accuracy 1",
                                "--irradiance-accuracy 1% --temperature-accuracy 0.5"))
    words += ["--leave-out", draw.of(*ids)] if len(ids) > 3 and draw.often(0.15) else []
    words += ["--fit-curves", "4", "--search-curves", "3"] if len(ids) > 4 and draw.often(0.12) else []
    return words + written


def families(draw):
    """Curves or key points of one device under several lights and temperatures, and a fit of all."""
    made, steps, ids = module(draw), [], []
    cells = ("--cells", str(made["cells"]))
    where = draw.weighed(simulated=35, table=35, matrix=30)
    if where == "matrix":
        source = "matrix.csv"
        given = [(source, matrix(draw, made, draw.log(1e-5, 3e-3)))]
    elif where == "table":
        source = "curves.csv"
        text, count = family(draw, made, draw.log(1e-4, 5e-3))
        given, ids = [(source, text)], [str(number + 1) for number in range(count)]
    else:
        source, given = "set", [("law.json", law_of(made)), ("set/about.md", "Made.\n")]
        for number in range(draw.whole(3, 7)):
            ids.append(f"s{number}")
            words = (f"--irradiance-Wm2 {draw.between(150, 1050):.1f} --temperature-C {draw.between(15, 65):.1f} --points "
                     f"{draw.whole(15, 40)} --noise-relative {draw.log(2e-4, 5e-3):.3g} --seed {draw.whole(0, 9999)}")
            steps.append(Step(("simulate", "--from", "law.json", *cells, *_words(words), "--out", f"set/s{number}.csv")))
    law = draw.weighed(desoto=32, pvsyst=32, cec=13, auto=13, free=0 if where == "matrix" else 10)
    words = _family_words(draw, made, law, where, ids) if law != "free" else []
    words += ["--seed", str(draw.whole(1, 99))] if draw.often(0.15) else []
    step = Step(("fit", source, *cells, "--family", law, *words, "--json", "family.json", "--csv", "family.csv"))
    return (*steps, step), tuple(given)


def _tandem(draw):
    """Parameters of two junctions but for their photocurrents, and a photocurrent; sometimes the larger gap is below."""
    current = draw.log(5e-3, 0.1)
    top, bottom = (device(draw, 1, current, voltage=volts, n=n) for volts, n in (((0.95, 1.2), (1.2, 1.8)), ((0.55, 0.72), (1.0, 1.4))))
    if draw.often(0.3):
        top, bottom = bottom, top
    values = {f"{symbol}{number}": part[name] for number, part in ((1, top), (2, bottom))
              for symbol, name in (("Is", "Is"), ("n", "n"), ("Rsh", "Rsh"))}
    return {**values, "Rs": top["Rs"]}, current


def _tandem_curve(draw, values, top, bottom, name, more=()):
    """A step that writes a curve of a tandem under its lights."""
    photo = {"Iph1": top, "Iph2": bottom}
    words = [word for symbol, value in {**values, **photo}.items() for word in ("--set", f"{symbol}={value:.6g}")]
    return Step(("simulate", "--junctions", "2", *words, "--cells", "1", "--temperature-C", "25", *more, "--noise-A",
                 f"{draw.log(1e-4, 2e-3) * top:.3g}", "--seed", str(draw.whole(0, 9999)), "--out", f"{name}.csv"))


def tandems(draw):
    """A tandem under one or several spectra, its lights stated or not, and a fit of all its curves."""
    values, current = _tandem(draw)
    names, steps, words = draw.some(["white", "red", "blue", "green"], draw.of(1, 2, 2, 3, 4)), [], []
    known, ratio = draw.of("all", "all", "but one", "none"), draw.between(0.9, 1.1)
    for number, name in enumerate(names):
        top, bottom = (1, 1) if number == 0 else (draw.between(0.75, 1.2), draw.between(0.75, 1.2))
        points = ("--points", str(draw.whole(25, 60)))
        steps.append(_tandem_curve(draw, values, current * top, current * ratio * bottom, name, points))
        unknown = known == "but one" and number == len(names) - 1 > 0
        light = draw.of(f"?:{bottom:.4g}", f"{top:.4g}:?", "?:?") if unknown else f"{top:.4g}:{bottom:.4g}"
        words += ["--light", f"{name}={light}"] if known != "none" else []
    files = [f"{name}.csv" for name in names]
    if draw.often(0.4):
        files = draw.some(files, len(files))  # in another order than the lights
    profiles = draw.often(0.3) and known == "all" and len(names) < 3  # else they take many seconds
    words += [] if profiles else ["--intervals", draw.of("none", "symmetric")]
    words += ["--iterations", str(draw.whole(8, 20))] if draw.often(0.6) else []
    step = Step(("fit", *files, "--junctions", "2", *words, "--json", "tandem.json"))
    return (*steps, step), ()


def cells(draw):
    """A laboratory cell, of one junction or two, and its description."""
    words = []
    if draw.often(0.2):
        values, current = _tandem(draw)
        names = draw.of(["lit"], ["up", "down"], ["full", "half"])
        lights = {"half": 0.5}
        span = {"up": "-0.1:1.9:45", "down": "1.9:-0.1:45"}
        steps = []
        for name in names:
            light = lights.get(name, 1)
            more = ("--voltages", span.get(name, "0:1.85:40"), "--irradiance-Wm2", f"{1000 * light:g}")
            steps.append(_tandem_curve(draw, values, current * light, 1.05 * current * light, name, more))
        files, given = [f"{name}.csv" for name in names], ()
        words += ["--area-cm2", draw.of("0.25", "1", "4")]
    else:
        steps = []
        files, given = laboratory_cell(draw)
    if draw.often(0.3):
        words += _words(draw.of("--largest-n 3", "--ideal-n 1.6", "--hysteresis 2", "--superposition 3", "--no-fit",
                                "--constants literature"))
    words += ["--html", "cell.html", "--plot", "cell.svg"] if draw.often(0.08) else []
    return (*steps, Step(("cell", *files, *words, "--json", "found.json", "--csv", "found.csv"))), given


def _hidden(draw, cells, together):
    """Effects that nobody knows of: none, one or two, of which one at most divides the cells."""
    names = [name for name in EFFECTS if (cells >= 36 or name not in OF_A_MODULE)
             and name not in (OF_ONE_LIGHT if together else OF_SEVERAL_LIGHTS)]
    chosen = draw.some(names, int(draw.weighed(**{"0": 25, "1": 65, "2": 10})))
    return chosen[:1] if set(chosen) <= OF_A_MODULE else chosen


def diagnoses(draw):
    """Curves with what nobody knows of, or nothing, and their diagnosis."""
    number = draw.of(1, 1, 1, 1, 36, 60, 60, 60, 72, 144)
    made = device(draw, number, draw.log(0.5, 12), voltage=(0.58, 0.72), n=(1.0, 1.6))
    made["Rs"] = min(made["Rs"], 0.04 * number * 0.6 / made["Iph"])
    together = draw.often(0.25)
    hidden = [word for name in _hidden(draw, number, together) for word in ("--with", _effect(draw, name, made))]
    noise = draw.log(5e-5, 3e-3) * made["Iph"]
    lights = draw.of((1000, 0), (1000, 500), (1000, 600, 200)) if together else (1000,)
    steps, files = [], []
    for light in lights:
        files.append(f"at{light}.csv")
        now = {**made, "Iph": made["Iph"] * light / 1000}
        points = ["--voltages", f"0:{0.72 * number:.4g}:40"] if not light else ["--points", draw.whole(25, 70)]
        steps.append(_simulated(now, *points, "--irradiance-Wm2", light, *(hidden if light else hidden[:0]), "--force", "--noise-A",
                                f"{noise:.3g}", "--seed", draw.whole(0, 9999), "--out", files[-1]))
    words = ["--together"] if together else []
    words += ["--no-held-out"] if draw.often(0.6) else []
    words += ["--base", "dd"] if draw.often(0.15) else []
    words += ["--noise", "white"] if draw.often(0.1) else []
    if draw.often(0.2):
        words += ["--effects", ",".join(sorted(draw.some([name for name in EFFECTS if number > 1 or name not in OF_A_MODULE], 4)))]
    if draw.often(0.3):
        words += _words(draw.of("--priors alike", "--probability 0.6", "--largest-causes 2", "--seed 5", "--folds 4",
                                "--floor-current 0 --floor-power 0"))
    words += ["--extend", "model.json"] if draw.often(0.2) and not any("weak_cell" in word for word in hidden) else []
    words += ["--verbose"] if draw.often(0.15) else []
    words += ["--html", "diagnosis.html"] if draw.often(0.03) else []
    step = Step(("diagnose", *files, *words, "--json", "diagnosis.json", "--csv", "diagnosis.csv", "--answers", "answers.json"))
    return (*steps, step), ()


def trends(draw):
    """A module over months, and what changed."""
    words = draw.of("", "", "--reference-days 45", "--least-irradiance 400", "--false-alarms 0.5", "--seed 4",
                    "--irradiance-drift 2 --temperature-drift 1")
    given, report = (("sweeps.csv", months(draw)),), f"{words} --json trend.json --csv trend.csv"
    if draw.often(0.2):
        return (step_of("trend sweeps.csv --append kept.state"), step_of(f"trend kept.state {report}")), given
    return (step_of(f"trend sweeps.csv {report}"),), given


KINDS = {fits: 1000, families: 200, tandems: 100, cells: 100, diagnoses: 300, trends: 20}
NAMES = [kind.__name__ for kind in KINDS]
SECONDS = {"fits": 0.1, "families": 0.2, "tandems": 0.5, "cells": 0.15, "diagnoses": 0.6, "trends": 0.15}  # about what a case takes


def corpus_cases(kinds=()):
    """The cases of these kinds, of all if none is named."""
    cases_of_all = []
    for kind, count in KINDS.items():
        name = kind.__name__
        for number in range(count if not kinds or name in kinds else 0):
            steps, given = kind(Draw(f"{name} {number}"))
            mark = zlib.crc32(repr((steps, given)).encode())
            cases_of_all.append(Case(f"{name}/{number:04}_{mark:08x}", steps, given, SECONDS[name]))
    return cases_of_all
