# %% [markdown]
# # A laboratory cell and a tandem
# All measurements of one cell are described together.

# %%
import lyrefit

cell = lyrefit.cell(["data/cell/pair.csv", "data/cell/lights.csv"])
print(cell.brief)
print(cell["hysteresis"][0]["index_power"])

# %% [markdown]
# Two junctions in series, under two lights.

# %%
device = {"Is1": 1e-14, "n1": 1.4, "Rsh1": 3000.0, "Is2": 3e-10, "n2": 1.2, "Rsh2": 1500.0, "Rs": 2.0}
white = lyrefit.simulate({**device, "Iph1": 0.0195, "Iph2": 0.0202}, junctions=2)
red = lyrefit.simulate({**device, "Iph1": 0.0195, "Iph2": 0.0101}, junctions=2)
light = {"white": (1, 1), "red": (1, 0.5)}
tandem = lyrefit.fit({"white": white, "red": red}, junctions=2, light=light, intervals="symmetric")
print(tandem.parameters["n_1"], tandem.parameters["n_2"])
