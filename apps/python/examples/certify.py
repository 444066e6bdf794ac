"""
Is there a better fit? A proof
==============================

No search can show that nothing better exists. ``certify`` proves a lower bound of the RMSE: for
one, two and three diodes within their bounds, and for any number of diodes, the floor.
"""

import os
import pathlib

import matplotlib.pyplot as plt

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
proof = lyrefit.certify(data / "rtc_france")
for model in proof["models"]:
    print(f"{model['model']}: best {model['rmse_A']:.9e} A, proved bound {model['lower_bound_A']:.9e} A")
assert proof.certified

# %%
# A certificate names its objective. The solved current, which fits minimise by default, has bounds
# of its own.

solved = lyrefit.certify(data / "rtc_france", objective="solved-current", models=["sd"])
print(f"solved-current: nothing below {solved['models'][0]['lower_bound_A']:.9e} A")

# %%
# Searches of 220, 2,020 and 20,020 evaluations against the bound, each before and after the
# polish. What is left after it is rounding.

bound = proof["models"][0]["lower_bound_A"]
for number, iterations in enumerate((10, 100, 1000)):
    for seed in range(15):
        rmse = lyrefit.fit(data / "rtc_france", objective="measured-current", intervals="none",
                           iterations=iterations, seed=seed)["rmse"]
        for key, color in (("searched", "C1"), ("refined", "C0")):
            label = key if number == seed == 0 else None
            plt.plot(number, max(rmse[key]["measured_current_A"] / bound - 1, 1e-12), "o", color=color, label=label)
assert rmse["refined"]["measured_current_A"] / bound - 1 < 1e-9
plt.yscale("log")
plt.xticks(range(3), ["220", "2,020", "20,020"])
plt.xlabel("evaluations of the search")
plt.ylabel("distance from the proved bound (relative)")
plt.legend()
plt.show()
