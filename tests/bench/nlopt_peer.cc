#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>

#include "peer.h"

namespace lyrefit::bench {
namespace {

struct Counted {
  const PeerProblem* problem;
  std::int64_t evaluations;
};

double GlobalObjective(unsigned, const double* unit, double*, void* data) {
  auto* counted = static_cast<Counted*>(data);
  ++counted->evaluations;
  return counted->problem->Rmse(unit);
}

double LocalObjective(unsigned, const double* unit, double* gradient, void* data) {
  auto* counted = static_cast<Counted*>(data);
  ++counted->evaluations;
  return counted->problem->MeanSquareAndGradient(unit, gradient);
}

// Continues from x. Exceptions at the limit of rounding or of SLSQP's iterations count as a regular
// end.
void Optimize(nlopt::opt* optimizer, std::vector<double>* x) {
  optimizer->set_lower_bounds(0.0);
  optimizer->set_upper_bounds(1.0);
  double value = 0;
  try {
    optimizer->optimize(*x, value);
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

NloptSettings TunedNlopt(Model model, Objective objective, bool told) {
  constexpr int kMostEvaluations = 100000;
  const bool solved = objective == Objective::kSolvedCurrent;
  const int corners = 2 * static_cast<int>(model) + 4;  // dimensions + 1
  if (told) return {2 * corners, kMostEvaluations, solved ? 1e-1 : 1e-2, 30, true};
  switch (model) {
    case Model::kSingleDiode:
      if (solved) return {3 * corners, kMostEvaluations, 1e-2, 2, false};
      return {2 * corners, kMostEvaluations, 1e-2, 8, false};
    case Model::kDoubleDiode:
      if (solved) return {3 * corners, kMostEvaluations, 1e-1, 5, false};
      return {2 * corners, kMostEvaluations, 1e-2, 16, false};
    default:
      if (solved) return {2 * corners, kMostEvaluations, 1e-1, 3, false};
      return {2 * corners, kMostEvaluations, 1e-2, 6, false};
  }
}

NloptSettings UniformNlopt(Model model) {
  NloptSettings settings =
      TunedNlopt(Model::kDoubleDiode, Objective::kMeasuredCurrent, /*told=*/false);
  settings.population = 2 * (2 * static_cast<int>(model) + 4);
  return settings;
}

PeerEnd RunNlopt(const PeerProblem& problem, std::uint64_t seed, const NloptSettings& settings) {
  const auto dimensions = static_cast<unsigned>(problem.dimensions());
  const double target = settings.told ? problem.target() : 0;
  Counted counted{&problem, 0};
  nlopt::srand(seed + 1);
  double best = HUGE_VAL;
  for (int round = 0; round < settings.rounds && best > target; ++round) {
    std::vector<double> x(dimensions, 0.5);
    nlopt::opt global(nlopt::GN_CRS2_LM, dimensions);
    global.set_min_objective(GlobalObjective, &counted);
    global.set_population(settings.population);
    global.set_maxeval(settings.global_evaluations);
    global.set_ftol_rel(settings.global_tolerance);
    global.set_stopval(target);
    Optimize(&global, &x);

    nlopt::opt local(nlopt::LD_SLSQP, dimensions);
    local.set_min_objective(LocalObjective, &counted);
    local.set_maxeval(2000);
    local.set_ftol_rel(1e-15);
    local.set_xtol_rel(1e-15);
    local.set_stopval(target * target);
    Optimize(&local, &x);
    best = std::min(best, problem.Rmse(x.data()));
  }
  return {best, counted.evaluations};
}

}  // namespace lyrefit::bench
