#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lyrefit/translate/translation_budget.h"
#include "translate/measured_sets.h"
#include "translate/study.h"

namespace shown {
namespace {

using lyrefit::Procedure;

std::vector<Carried> Where(const std::vector<Carried>& all, bool (*keep)(const Carried&)) {
  std::vector<Carried> kept;
  for (const Carried& row : all) {
    if (keep(row)) kept.push_back(row);
  }
  return kept;
}

void ShowSet(const MeasuredSet& set, const StudyOptions& options) {
  const std::vector<Sweep> sweeps = Steady(MakeReady(set.curves, set.options, options.threads));
  const double scatter = LikeScatter(sweeps);
  std::printf(
      "## %s\n\n%zu sweeps; Pmax of sweeps in like conditions scatters by %.2f %% (standard "
      "deviation of one).\n\n",
      set.name.c_str(), sweeps.size(), 100 * scatter);
  for (const double factor : {1.0, 0.7, 1.4}) {
    const Conditions at = ConditionsOf(factor * scatter);
    const auto all = CarryPairs(sweeps, at, {options.pairs, options.seed, options.threads, {}});
    std::printf(
        "Conditions of both ends doubted by %.2f %% of Pmax (k = 2), %g times what was "
        "found:\n\n",
        at.light_percent, factor);
    PrintTable(all);
    if (factor == 1) {
      std::printf("\n");
      PrintHeld(all);
      std::printf(
          "\nThe recommended one by step:\n\n| step | n | bias | rms | mean U | within U |\n");
      std::printf("|---|---|---|---|---|---|\n");
      const auto print = [&](const char* name, bool (*keep)(const Carried&)) {
        const Tally tally = TallyOf(Where(all, keep), std::nullopt, true);
        if (tally.count == 0) return;
        std::printf("| %s | %d | %+.2f %% | %.2f %% | %.2f %% | %.1f +- %.1f %% |\n", name,
                    tally.count, 100 * tally.bias, 100 * tally.rms, 100 * tally.expanded,
                    100 * tally.within, 100 * tally.within_se);
      };
      print("light 10 %, 5 K",
            [](const Carried& row) { return row.folds < 0.1 && row.heat < 0.5; });
      print("light 30 %, 15 K, not less", [](const Carried& row) {
        return row.folds < 0.3 && row.heat < 1.5 && !(row.folds < 0.1 && row.heat < 0.5);
      });
      print("light more", [](const Carried& row) { return row.folds >= 0.3; });
      print("temperature more",
            [](const Carried& row) { return row.folds < 0.3 && row.heat >= 1.5; });
    }
    std::printf("\n");
  }
}

struct Split {
  const char* name;
  // 0: the sweep is in the first half, 1: in the second.
  int (*part)(int place, const Sweep& sweep);
};

constexpr Split kSplits[] = {
    {"even / odd sweeps", [](int place, const Sweep&) { return place % 2; }},
    {"below / above 40 C",
     [](int, const Sweep& sweep) { return sweep.made.inputs.values.temperature_C > 40 ? 1 : 0; }},
    {"below / above 650 W/m2",
     [](int, const Sweep& sweep) {
       return sweep.made.inputs.values.irradiance_W_m2 > 650 ? 1 : 0;
     }},
};

}  // namespace

int StudySets(const StudyOptions& options) {
  for (const auto& set :
       {SandiaSet(options.data, options.every), NistSet(options.data, {"2015-07-20", 1.0}, 1),
        NistSet(options.data, {"2015-07-20", 1.1}, 1),
        NistSet(options.data, {"2015-07-20", 1.2}, 1),
        NistSet(options.data, {"2015-07-01", 1.1}, options.every)}) {
    if (!set) {
      std::fprintf(stderr, "%s\n", set.error().ToString().c_str());
      return 1;
    }
    ShowSet(*set, options);
  }
  return 0;
}

int StudyHalves(const StudyOptions& options) {
  const auto set = SandiaSet(options.data, options.every);
  if (!set) {
    std::fprintf(stderr, "%s\n", set.error().ToString().c_str());
    return 1;
  }
  const std::vector<Sweep> sweeps = Steady(MakeReady(set->curves, set->options, options.threads));
  const Conditions at = ConditionsOf(LikeScatter(sweeps));
  std::printf(
      "| split | procedure | fitted to one part: light, 10 K | within U in the other | in use: "
      "light, "
      "10 K | within U in the other |\n|---|---|---|---|---|---|\n");
  for (const Split& split : kSplits) {
    std::vector<Carried> parts[2];
    for (int part = 0; part < 2; ++part) {
      Pairing how = {options.pairs, options.seed, options.threads, {}};
      for (int i = 0; i < static_cast<int>(sweeps.size()); ++i) {
        how.allowed.push_back(split.part(i, sweeps[i]) == part);
      }
      parts[part] = CarryPairs(sweeps, at, how);
    }
    for (const Procedure procedure : {Procedure::kIec1, Procedure::kIec2, Procedure::kIec4,
                                      Procedure::kDeSoto, Procedure::kPvsyst}) {
      const lyrefit::TranslationError own = lyrefit::TranslationErrorOf(procedure);
      for (int learnt = 0; learnt < 2; ++learnt) {
        const Sizes sizes = FittedSizes(parts[learnt], procedure);
        const std::vector<Carried>& other = parts[1 - learnt];
        const Tally fitted = TallyOf(WithSizes(other, sizes), procedure, false);
        const Tally in_use = TallyOf(other, procedure, false);
        std::printf(
            "| %s, %s | %s | %.1f %%, %.2f %% | %.1f +- %.1f %% | %.1f %%, %.2f %% | %.1f %% |\n",
            split.name, learnt == 0 ? "first" : "second", lyrefit::ToText(procedure).c_str(),
            100 * sizes.light, 100 * sizes.temperature, 100 * fitted.within, 100 * fitted.within_se,
            100 * own.light[lyrefit::kMaxPowerOutput],
            100 * own.temperature[lyrefit::kMaxPowerOutput], 100 * in_use.within);
      }
    }
  }
  return 0;
}

}  // namespace shown
