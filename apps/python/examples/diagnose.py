"""
What is wrong with this curve?
==============================

A diagnosis fits the diode model, compares what it misses with a catalogue of some forty causes,
and names one only where the readings show it beyond their errors. The module here has one
substring with 2.5 % less light than the others.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data" / "diagnosis"
found = lyrefit.diagnose(data / "shaded_module.csv", extend=True, held_out=False)
print(found.sentence)
for cause in found["verdict"]["causes"]:
    print(f"{cause['title']}, {100 * cause['probability']:.0f} %: {cause['in_words'][0]}")
    print("to do:", cause["action"])
    for other in cause["alternatives"]:
        print(f"or: {other['title']}, {100 * other['probability']:.0f} %")
assert found.causes == ["shading"]

# %%
# The most probable candidates. The first two are partial shading, of one depth and of a light for
# each substring: the sentence adds them up.

candidates = found.frame().sort_values("probability", ascending=False)
print(candidates[["effect", "title", "probability"]].head().to_string(index=False))

# %%
# Some were not tried, and why not.

print(candidates[~candidates.tried][["effect", "why_not"]].head().to_string(index=False))

# %%
# The model with its cause is a fit like any other; its parameters are those of the module without
# the shade.

plain = lyrefit.fit(data / "shaded_module.csv", as_is=True)
curve, extended = plain.curve, found.extended
assert extended is not None
isc = np.max(curve.current)
plt.plot(curve.voltage, 100 * plain.residual / isc, ".-", label="single diode alone")
plt.plot(curve.voltage, 100 * extended.residual / isc, ".-", label="with partial shading")
plt.axhspan(-0.2, 0.2, alpha=0.15, color="C2", label="healthy modules")
plt.xlabel("voltage (V)")
plt.ylabel("residual (% of Isc)")
plt.legend()
plt.show()
