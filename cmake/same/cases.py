"""All cases: of the verbs (verbs/VERB.txt), of the pages of the repository and of the measurements in the data folders."""

import pathlib

from case import cases_of
from inputs import FILES
from pages import page_cases
from sweeps import SWEEPS, sweep_cases

HERE = pathlib.Path(__file__).resolve().parent

WORDS = {
    "NOTHING": "",
    "PLAIN": "data/formats/head_tracer.csv",
    "DEVICE": "simulate --set Iph=8.2 --set Is1=2e-9 --set n1=1.15 --set Rs=0.25 --set Rsh=300 --cells 60 --temperature-C 25",
    "TANDEM": "simulate --junctions 2 --set Is1=1e-14 --set n1=1.4 --set Rsh1=3000 --set Is2=3e-10 --set n2=1.2 "
              "--set Rsh2=1500 --set Rs=2 --noise-A 2e-5",
    "SMALL": "--folds 0 --no-individual-fits --iterations 20 --population 15",
    "QUICK": "--runs 2 --population 10 --iterations 20",
    "SHEET": "datasheet --isc 4.75 --voc 21.6 --imp 4.26 --vmp 17.6 --alpha 0.002 --beta -0.076 --cells 36",
    "VERBS": "fit|simulate|certify|compare|inspect|datasheet|audit|diagnose|cell|trend|translate|pack|batch|merge|cite",
    "ALL_PAGMO": "|".join(f"pagmo:{name}" for name in (
        "de sade de1220 cmaes xnes pso pso_gen gwo bee_colony gaco sga ihs sea simulated_annealing").split()),
    "EFFECTS": "second_diode|nonohmic_shunt|breakdown|collection|photoshunt|back_contact|rs_current|distributed_rs|aged_contacts|"
               "series_resistance|shading|"
               "mismatch|substrings|covered_edge|weak_cell|dim_cells|scatter|leaky_cell|graded_shunt|bypass_open|bypass_short|"
               "open_substring|drift|irr_step|transient|temp_drift|hysteresis|capacitance|timing_skew|clip|range_switch|outliers|"
               "quantisation|voltage_bins|current_offset|voltage_offset|sensor_offset|sensor_nonlin|temp_offset|temp_gradient|"
               "bandgap|isc_tempco|temperature_or_cells|unknown_structure",
}


def all_cases(root, links, most=SWEEPS):
    """The cases for the repository at `root` and data folders under their names in `links`; no two with one name. Of a
    folder at most so many files are taken; without a limit all are, and all cases run."""
    cases = {}
    for file in sorted((HERE / "verbs").glob("*.txt")):
        for case in cases_of(file.stem.replace("_", "/", 1), file.read_text(encoding="utf-8"), WORDS, FILES):
            cases.setdefault(case.name, case)
    for case in page_cases(root):
        cases.setdefault(case.name, case)
    for link, folder in links.items():
        for case in sweep_cases(pathlib.PurePosixPath(link), folder, most):
            cases.setdefault(case.name, case)
    return [case for case in cases.values() if most is None or not case.full]
