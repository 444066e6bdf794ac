"""pvlib's own case of fit_desoto_sandia, with lyrefit's function in its place.

A module of 96 cells (Canadian Solar CS5P-220P of the CEC library) is computed by De Soto's equations
at 28 conditions, and its parameters are fitted back. Runs without pvlib; where pvlib and statsmodels
are there, pvlib's function fits the same curves beside it.
"""

# %% The curves: De Soto's equations, as pvlib's calcparams_desoto has them
import time

import numpy as np

from lyrefit.pvlib import fit_desoto_sandia, i_from_v, singlediode

TRUTH = {"I_L_ref": 5.056, "I_o_ref": 1.01e-10, "R_sh_ref": 837.51, "R_s": 1.004, "a_ref": 2.3674}
SPECS = {"alpha_sc": 0.0025, "beta_voc": -0.19659, "cells_in_series": 96}
K_EV = 1.380649e-23 / 1.602176634e-19


def desoto(ee, tc, I_L_ref, I_o_ref, R_sh_ref, R_s, a_ref, EgRef=1.121, dEgdT=-0.0002677, **_):
    """The five parameters of the single-diode equation at irradiance ee and cell temperature tc."""
    reference_K, cell_K = 298.15, tc + 273.15
    gap = EgRef * (1 + dEgdT * (cell_K - reference_K))
    photocurrent = ee / 1000 * (I_L_ref + SPECS["alpha_sc"] * (cell_K - reference_K))
    saturation_current = I_o_ref * (cell_K / reference_K) ** 3 * np.exp(
        (EgRef / reference_K - gap / cell_K) / K_EV)
    return (photocurrent, saturation_current, np.full_like(ee, R_s), R_sh_ref * 1000 / ee,
            a_ref * cell_K / reference_K)


ee = np.tile(np.arange(400.0, 1001.0, 100.0), 4)
tc = np.repeat([15.0, 25.0, 35.0, 45.0], 7)
devices = desoto(ee, tc, **TRUTH)
iph, io, rs, rsh, nNsVth = devices
points = singlediode(iph, io, rs, rsh, nNsVth, ivcurve_pnts=300)
curves = {**points, "ee": ee, "tc": tc}

# %% The fit, and what comes of its parameters on all readings


def fit_and_tell(name, fit, measured):
    began = time.perf_counter()
    found = fit(measured, SPECS)
    seconds = time.perf_counter() - began
    rows = [row[:, np.newaxis] for row in desoto(ee, tc, **found)]
    model = i_from_v(measured["v"], *rows)
    rmse = np.sqrt(np.mean((model - measured["i"]) ** 2))
    values = ", ".join(f"{key} {found[key]:.6g}" for key in (*TRUTH, "EgRef"))
    print(f"{name}: {values}; RMSE of the current {rmse:.3g} A, {seconds:.2f} s")
    return found, rmse


noise = np.random.default_rng(7).normal(scale=5e-4, size=points["i"].shape)
cases = {"exact curves": curves, "with noise of 0.5 mA": {**curves, "i": points["i"] + noise}}
functions = {"lyrefit": fit_desoto_sandia}
try:
    import statsmodels.api  # noqa: F401  what pvlib's function needs besides
    from pvlib.ivtools import sdm

    functions["pvlib"] = sdm.fit_desoto_sandia
except ImportError:
    print("pvlib's own function is not there: pvlib or statsmodels is missing")
answers = {}
for case, measured in cases.items():
    for name, function in functions.items():
        answers[name, case] = fit_and_tell(f"{name}, {case}", function, measured)

# %% Where the two differ
# pvlib goes curve by curve: a shunt from the co-content integral, a common n from a line through Voc
# over ln(ee), Rs and Rsh so that each maximum power point comes out, then lines over the conditions
# for the reference; so even exact curves come back with errors of up to a percent or so. Its EgRef,
# 1.311 eV where the curves were made with 1.121, is not a matter of method: the term of dEgdT enters
# its regression with the sign that belongs to a positive dEgdT.
