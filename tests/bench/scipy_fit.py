"""What a careful user of SciPy writes: differential evolution, then bounded least squares.

Two diodes, solved-current, RTC France; run from the top of the repository, to time whole commands.
"""
import os

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from scipy.optimize import differential_evolution, least_squares

VOLTAGE, CURRENT = np.loadtxt("data/rtc_france/curve.csv", delimiter=",", skiprows=1).T
VT = 1.380649e-23 * 306.15 / 1.602176634e-19
LARGEST = 200  # exponent


def model(x):
    """Current at every voltage, by Newton's method on the junction voltage."""
    iph, log_is1, n1, rs, conductance, log_is2, n2 = x
    is1, is2 = np.exp(log_is1), np.exp(log_is2)
    vd = VOLTAGE + rs * CURRENT
    for _ in range(40):
        e1 = is1 * np.exp(np.minimum(vd / (n1 * VT), LARGEST))
        e2 = is2 * np.exp(np.minimum(vd / (n2 * VT), LARGEST))
        current = iph - (e1 - is1) - (e2 - is2) - vd * conductance
        slope = -e1 / (n1 * VT) - e2 / (n2 * VT) - conductance
        step = (vd - VOLTAGE - rs * current) / (1 - rs * slope)
        vd = vd - step
        if np.max(np.abs(step)) < 1e-12:
            break
    return current - slope * step


def residual_mA(x):
    return 1e3 * (model(x) - CURRENT)


BOUNDS = [(0, 1.5), (-29, -6.5), (1, 2), (0, 0.37), (1e-6, 2.6), (-29, -6.5), (1, 2)]
LOWER, UPPER = np.array(BOUNDS, dtype=float).T
best = differential_evolution(lambda x: np.mean(residual_mA(x) ** 2), BOUNDS, seed=0, maxiter=100,
                              popsize=10, polish=False)
fit = least_squares(residual_mA, np.clip(best.x, LOWER + 1e-9, UPPER - 1e-9),
                    bounds=(LOWER, UPPER), x_scale="jac", ftol=1e-15, xtol=1e-15, gtol=1e-15,
                    max_nfev=2000)
print(f"RMSE {1e-3 * np.sqrt(np.mean(fit.fun**2)):.12e} A solved-current")
