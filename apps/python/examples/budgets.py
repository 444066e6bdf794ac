"""
How much search is enough
=========================

Two loops over ``compare``: how many evaluations a search needs until its runs reach the proved optimum, and what Pm and gamma do to MLO.
"""

import lyrefit

# %%
# Runs of 20 that reach the optimum, by evaluations: the search alone (within 1e-6), one plain solve from its best candidate,
# the best candidate's own polish, all starts (within 1e-9). The population is about the root of the evaluations.

for budget in (10, 100, 1000, 10000):
    population = min(max(round(budget**0.5), 4), 100)
    found = lyrefit.compare("data/rtc_france", models="sd", bounds="table1", algorithms="mlo,de,random", runs=20, rankings=False,
                            plain_polish=True, population=population, iterations=max(-(-budget // population) - 1, 1), max_evaluations=budget)
    for row in found["problems"][0]["algorithms"]:
        print(budget, row["name"], row["searched"]["within_1e6"], row["plain_polished"]["within_1e9"],
              row["refined_best_candidate"]["within_1e9"], row["refined"]["within_1e9"])

# %%
# Mean RMSE in A of the search alone, and its standard deviation, by Pm and gamma. A rate of 0 switches MLO's memory-based strategy off, a
# distance coefficient of 0 its diversity strategy.

for rate in (0, 0.5, 1):
    for distance in (0, 0.5, 1):
        found = lyrefit.compare("data/rtc_france", models="td", bounds="literature", constants="literature", algorithms="mlo", runs=5,
                                rankings=False, polish=False, memory_rate=rate, distance_coefficient=distance, iterations=100)
        searched = found["problems"][0]["algorithms"][0]["searched"]
        print(f"Pm={rate} gamma={distance}: {searched['mean_A']:.4e} +- {searched['std_A']:.1e}")
