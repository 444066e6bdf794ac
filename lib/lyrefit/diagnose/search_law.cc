#include "lyrefit/diagnose/search_law.h"

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/model/reading_blocks.h"

namespace lyrefit {
namespace {

// Box of the search for the parameters, with ranges that hold for all curves.
Box SearchBox(const Selection& selection) {
  const Law& law = selection.extended.law;
  const std::vector<double>& p = selection.extended.p;
  Box box;
  const double iph = selection.base.p[kBasePhotocurrent];
  box.lower = {0.8 * iph, -3, 0.5, 0, 0};
  box.upper = {1.2 * iph, 2, 3, 0.3, 1};
  if (law.model == Model::kDoubleDiode) {
    box.lower.push_back(0);
    box.upper.push_back(1);
  }
  for (int k = static_cast<int>(box.lower.size()); k < law.base_size(); ++k) {
    box.lower.push_back(law.Lower(k));
    box.upper.push_back(law.Upper(k));
  }
  for (int k = law.base_size(); k < law.size(); ++k) {
    const bool fixed = law.Searched(k);
    box.lower.push_back(fixed ? p[k] : law.Lower(k));
    box.upper.push_back(fixed ? p[k] + 1e-12 : law.Upper(k));
  }
  return box;
}

}  // namespace

LawSearch SearchLaw(const Selection& selection, std::uint64_t seed, const Observer& observer) {
  const WeightedData& weighted = selection.weighted;
  const Readings& readings = *weighted.readings;
  const Law& law = selection.extended.law;
  std::vector<double> current(readings.points.size());
  // The workspace starts afresh each time: the value must not depend on the previous candidate.
  const std::vector<ReadingBlock> blocks = BlocksOf(readings);
  LawWorkspace workspace(blocks);
  const auto rmse = [&](const double* p) {
    if (!EvaluateLaw(law, readings, p, &workspace, current.data(), nullptr)) return kInfinity;
    return RmseOf(weighted, current);
  };
  LawSearch searched;
  searched.options.seed = seed;
  searched.options.population = 40;
  searched.options.iterations = 100;
  const Box box = SearchBox(selection);
  searched.summary = Search(rmse, box, searched.options, observer);
  searched.best = searched.summary.best.x;
  searched.rmse.searched.solved_current_A = searched.summary.best.objective;
  SearchOptions random = searched.options;
  random.algorithm = Algorithm::kRandom;
  searched.rmse.random_baseline.solved_current_A =
      Search(rmse, box, random, observer).best.objective;
  const LawFit polished = FitLaw(weighted, law, searched.best);
  if (polished.usable) {
    searched.rmse.refined_best_candidate.solved_current_A = RmseOf(weighted, polished.current);
  }
  return searched;
}

}  // namespace lyrefit
