#include "lyrefit/diagnose/search_law.h"

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/model/make_readings.h"

namespace lyrefit {
namespace {

// Box of the search for the coordinates, with ranges that hold for all curves.
Box SearchBox(const Selection& selection, const LawCoordinates& coordinates) {
  const Law& law = selection.extended.law;
  const std::vector<double> theta = coordinates.Of(selection.extended.p);
  const double iph = coordinates.Of(selection.base.p)[kIph];
  Box box;
  box.lower = {0.8 * iph, -3, 0.5, 0, 0};
  box.upper = {1.2 * iph, 2, 3, 0.3, 1};
  if (law.model == Model::kDoubleDiode) {
    box.lower.push_back(0);
    box.upper.push_back(1);
  }
  const LeastSquaresProblem problem = coordinates.Problem();
  for (int k = static_cast<int>(box.lower.size()); k < law.size(); ++k) {
    const bool fixed = problem.fixed[k] != 0;
    box.lower.push_back(fixed ? theta[k] : problem.lower[k]);
    box.upper.push_back(fixed ? theta[k] + 1e-12 : problem.upper[k]);
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
  const LawCoordinates coordinates(law, readings);
  const auto rmse = [&](const double* theta) {
    if (!coordinates.Evaluate(theta, &workspace, current.data(), nullptr)) return kInfinity;
    return RmseOf(weighted, current);
  };
  LawSearch searched;
  searched.options.seed = seed;
  searched.options.population = 40;
  searched.options.iterations = 100;
  const Box box = SearchBox(selection, coordinates);
  searched.summary = Search(rmse, box, searched.options, observer);
  searched.best = coordinates.Parameters(searched.summary.best.x);
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
