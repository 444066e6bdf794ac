#!/usr/bin/env python3
"""Currents that two_junctions_test.cc expects, from SciPy: nested bracketing (Brent) of the current and of
each junction's voltage.

    python3 two_junctions_reference.py
"""
import math

from scipy.optimize import brentq

VT = 1.380649e-23 * 298.15 / 1.602176634e-19
DEVICES = [
    # Iph1, Is1, n1, Rsh1, Iph2, Is2, n2, Rsh2, Rs
    [0.0195, 1e-14, 1.4, 3000, 0.0202, 3e-10, 1.2, 1500, 2.0],
    [0.0140, 2e-23, 1.15, 2e4, 0.0128, 1e-17, 1.1, 5e4, 0.8],
    [4.4, 1e-16, 1.9, 5, 7.8, 1e-9, 1.05, 0.6, 0.03],
    [0.0195, 1e-14, 1.4, 80, 0.002, 3e-10, 1.2, 1500, 2.0],
]


def junction_voltage(j, p, current):
    iph, isat, n, rsh = p[4 * j: 4 * j + 4]
    def excess(u):
        return iph - isat * math.expm1(min(u / (n * VT), 600)) - u / rsh - current
    low, high = -1.0, 1.0
    while excess(low) < 0:
        low *= 2
    while excess(high) > 0:
        high *= 2
    return brentq(excess, low, high, xtol=1e-16, rtol=9e-16, maxiter=500)


def current(p, voltage):
    def excess(i):
        return junction_voltage(0, p, i) + junction_voltage(1, p, i) - i * p[8] - voltage
    size = max(p[0], p[4])
    low, high = -size, size
    while excess(low) < 0:
        low *= 2
    while excess(high) > 0:
        high *= 2
    return brentq(excess, low, high, xtol=1e-18, rtol=9e-16, maxiter=500)


for k, device in enumerate(DEVICES):
    for voltage in [-0.5, 0.0, 0.6, 1.1, 1.4, 1.7, 2.4]:
        print("    {%d, %.1f, %.16e}," % (k, voltage, current(device, voltage)))
