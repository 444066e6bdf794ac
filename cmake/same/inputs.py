"""Small files that cases are given, by name: settings, and inputs that are refused."""

_CELL = "voltage_V,current_A\n0,0.76\n0.1,0.759\n0.2,0.757\n0.3,0.754\n0.4,0.72\n0.45,0.65\n0.5,0.48\n0.54,0.25\n0.57,0.0\n0.58,-0.1\n"
_ROWS = "source,device,model,algorithm,rmse_A,Iph_A,Rs_ohm,Rsh_ohm,Is1_A,n1\n"

FILES = {
    "errors.json": '{"current_noise_A": 1e-3, "voltage_noise_V": 0, "path_of_isc": 2e-3}\n',
    "box.json": '{"Iph": [0, 2], "Is": [0, 5e-5], "n": [1, 2], "Rs": [0, 0.36], "Rsh": [0, 1000]}\n',
    "priors.json": '{"shading": 0.3, "clip": 0.01}\n',
    "coefficients.json": '{"alpha_sc_A_K": 0.004, "beta_oc_V_K": -0.11, "resistance_series_ohm": 0.3, "kappa_ohm_K": 0.001}\n',
    "module.json": '{"name": "M", "rated_power_W": 290, "gamma_pmp_percent_K": -0.4, "beta_oc_percent_K": -0.28, '
                   '"alpha_sc_percent_K": 0.05, "technology": "c-Si"}\n',
    "device.json": '{"a_ref": 1.0, "I_L_ref": 5, "I_o_ref": 1e-9, "R_s": 0.2, "R_sh_ref": 300, "alpha_sc": 0.002}\n',
    "string.json": '{"bypass_diode": {"voltage_V": 0.5}, "strings": [[{"bypass": true, "times": 2, "cells": [{"count": 20}]}, '
                   '{"bypass": true, "cells": [{"count": 19}, {"count": 1, "light": 0.4}]}]]}\n',
    "claims.csv": _ROWS + "Table 1,rtc_france,sd,A,9.8602E-04,0.76078,0.03638,53.7185,3.2302E-07,1.48119\n"
                          "Table 2,rtc_france,sd,B,7.0E-04,0.76078,0.03638,53.7185,3.2302E-07,1.48119\n"
                          "Table 3,nowhere,sd,C,1E-03,1,0.1,10,1E-07,1.5\nTable 4,rtc_france,sd,D,9E-04,,,,,\n",
    "points.csv": _CELL,
    "points.json": '{"cells_in_series": 1, "nominal_temperature_C": 25, "area_cm2": 4}\n',
    # What is refused, or doubted.
    "empty.csv": "",
    "header.csv": "voltage_V,current_A\n",
    "letters.csv": _CELL + "0.59,abc\n",
    "not_finite.csv": _CELL + "inf,0\n",
    "unequal.csv": _CELL + "0.6\n",
    "one_column.csv": "voltage_V\n0\n0.1\n0.2\n",
    "three_points.csv": "voltage_V,current_A\n0,1\n0.3,0.9\n0.6,0\n",
    "exchanged.csv": "voltage_V,current_A\n" + "".join(f"{i},{v}\n" for v, i in (line.split(",") for line in _CELL.split()[1:])),
    "milliampere.csv": "voltage_V,current_A\n" + "".join(
        f"{v},{float(i) * 1000:g}\n" for v, i in (line.split(",") for line in _CELL.split()[1:])),
    "overflow.csv": _CELL + "0.6,9.91e37\n",
    "torn.json": '{"voltage_V": [0, 1, 2], "current_A": [1,',
    "torn_box.json": '{"Iph": [0, 2],\n "Is": [0\n',
    "torn.jsonl": '{"id": "a", "voltage_V": [0, 0.5], "current_A": [1, 0]}\n{"id": "b", "voltage_V": [0,\n{"id": "a"}\n',
    "torn.state": '{"trend": 1',
    "bad_rows.csv": _ROWS + "T,rtc_france,qd,A,x,1,2,3,4,5\n",
    "bad_plan.csv": "id,modules_in_series,strings_in_parallel,module\nelm,many,1,module.json\n",
    "bad_string.json": '{"strings": [[{"cells": [{"count": 0}]}]]}\n',
}
