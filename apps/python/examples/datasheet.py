# %% [markdown]
# A module from its data sheet alone: the five parameters that give what is printed, and how exactly.

# %%
import lyrefit

# %% As printed: texts keep their digits, coefficients may be in percent
module = lyrefit.fit_datasheet(v_mp="30.3", i_mp="8.58", v_oc="37.8", i_sc="9.05", alpha_sc="0.06%",
                               beta_voc="-0.31%", cells_in_series=60, gamma_pmp="-0.41", technology="Multi-c-Si")
print(module)
assert module.usable

# %% How far the rounding leaves each parameter open
print(module.frame())

# %% Ready for pvlib.pvsystem.calcparams_desoto
print(module.pvlib["parameters"])

# %% A number is exact; what cannot be a module is said
exact = lyrefit.fit_datasheet(30.3, 8.58, 37.8, 9.05, 0.0054, -0.117, 60)
print(exact.parameters["R_s"])
try:
    lyrefit.fit_datasheet(30.3, 9.58, 37.8, 9.05, 0.0054, -0.117, 60)
except lyrefit.Error as error:
    print(error)
