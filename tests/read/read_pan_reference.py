#!/usr/bin/env python3
"""Figures that read_pan_test.cc expects of a .PAN file, from its text and SciPy alone.

    python3 read_pan_reference.py FILE.PAN

The photocurrent and the saturation current make the curve at 1000 W/m2 and 25 C pass Isc and Voc (fsolve); then
PVsyst's law at other conditions, with every key point found on the curve by root finding and minimisation.
"""
import sys

import numpy as np
from scipy.constants import Boltzmann, elementary_charge
from scipy.optimize import brentq, fsolve, minimize_scalar

K_EV = Boltzmann / elementary_charge
TREF = 298.15
GAPS = {"mtSiMono": 1.12, "mtSiPoly": 1.12, "mtHIT": 1.12, "mtCIS": 1.03, "mtCdTe": 1.5}
CONDITIONS = [(1000, 25), (800, 45), (200, 25), (1100, 65), (50, 5)]

pan = {}
for line in open(sys.argv[1], encoding="utf-8-sig"):
    key, equals, value = line.strip().partition("=")
    if equals and key not in pan:
        pan[key] = value
number = {key: float(pan[key]) for key in ("NCelS", "Isc", "Voc", "muISC", "RShunt", "Rp_0", "Rp_Exp", "RSerie",
                                          "Gamma", "muGamma")}
loss, built_in = float(pan.get("D2MuTau", 0)), 0.9 * number["NCelS"]
gap = GAPS[pan["Technol"]]


def parameters(light, kelvin, photocurrent, saturation):
    g, dt = light / 1000, kelvin - TREF
    gamma = number["Gamma"] + number["muGamma"] * dt
    fade = np.exp(-number["Rp_Exp"])
    base = (number["RShunt"] - number["Rp_0"] * fade) / (1 - fade)
    return (g * (photocurrent + 1e-3 * number["muISC"] * dt),
            saturation * (kelvin / TREF) ** 3 * np.exp(gap / (K_EV * gamma) * (1 / TREF - 1 / kelvin)),
            number["NCelS"] * gamma * K_EV * kelvin,
            base + (number["Rp_0"] - base) * np.exp(-number["Rp_Exp"] * g))


def at_junction(volt, device):
    photocurrent, saturation, thermal, shunt = device
    return (photocurrent * (1 - (loss / (built_in - volt) if loss else 0))
            - saturation * np.expm1(volt / thermal) - volt / shunt)


def terminal(volt, device):
    return volt - at_junction(volt, device) * number["RSerie"]


def misses(logs):
    device = parameters(1000, TREF, *np.exp(logs))
    return [at_junction(number["Isc"] * number["RSerie"], device) / number["Isc"] - 1,
            at_junction(number["Voc"], device) / number["Isc"]]


start = np.log([number["Isc"], number["Isc"] * np.exp(-number["Voc"] / (number["NCelS"] * number["Gamma"] * K_EV * TREF))])
found = np.exp(fsolve(misses, start, xtol=1e-12))
print(f"I_L_ref {found[0]:.10g}  I_o_ref {found[1]:.10g}")
for light, celsius in CONDITIONS:
    device = parameters(light, celsius + 273.15, *found)
    most = 0.999 * built_in if loss else 2 * number["Voc"]
    voc = brentq(lambda v: at_junction(v, device), 0, most, xtol=1e-13)
    isc = at_junction(brentq(lambda v: terminal(v, device), -1, voc, xtol=1e-14), device)
    best = minimize_scalar(lambda v: -at_junction(v, device) * terminal(v, device), bounds=(0, voc), method="bounded",
                           options={"xatol": 1e-10})
    print(f"{{{light}, {celsius}, {isc:.9g}, {voc:.9g}, {-best.fun:.9g}}},")
