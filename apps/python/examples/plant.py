"""
A plant of 500 strings
======================

Every string is fitted and compared with the strings of its combiner and with the plan of the
plant. Faults that leave the shape of a curve alone, such as a missing module, are named that way.
The command does this: a row of results a string.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import matplotlib.pyplot as plt
import pandas as pd

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data" / "plant"
places = os.pathsep.join([str(pathlib.Path(sys.executable).parent), os.environ.get("PATH", "")])
command = os.environ.get("LYREFIT_COMMAND") or shutil.which("lyrefit", path=places)
if not command:
    sys.exit("no command lyrefit beside Python or on the PATH; LYREFIT_COMMAND can name it")
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([command, "batch", data / "strings.csv", "--plan", data / "plan.csv",
                    "--out", folder, "--quiet"], check=True)
    strings = pd.read_csv(pathlib.Path(folder) / "results.csv")
named = strings[strings.plan_cause.notna()]
print(named[["id", "plan_cause", "plan_probability", "plan_lost_W"]].to_string(index=False))
assert set(named.plan_cause) == {"missing_module", "bypassed_substring", "cable_resistance", "uniform_soiling"}

# %%
# What to do about the first of them.

print(named.iloc[0].plan_sentence, "-", named.iloc[0].plan_action)

# %%
# Current and voltage beside those of the combiner: a string that departs in one of them is a fault
# of that kind.

plt.plot(strings.group_Isc_percent, strings.group_Voc_percent, ".", color="C5", label="strings")
for number, row in enumerate(named.itertuples()):
    plt.plot(row.group_Isc_percent, row.group_Voc_percent, "o", markersize=8, color=f"C{number}",
             label=row.plan_cause.replace("_", " "))
plt.xlabel("Isc against the combiner (%)")
plt.ylabel("Voc against the combiner (%)")
plt.legend()
plt.show()
