#include <algorithm>
#include <cmath>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

#include "peer.h"

namespace lyrefit::bench {
namespace {

struct UnitBox {
  const PeerProblem* problem = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    return {problem->Rmse(x.data())};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const auto dimensions = static_cast<std::size_t>(problem->dimensions());
    return {pagmo::vector_double(dimensions, 0.0), pagmo::vector_double(dimensions, 1.0)};
  }
};

// Whether the population has converged: the objectives of all individuals are equal to 1e-12.
bool StoodStill(const pagmo::population& population) {
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (const pagmo::vector_double& f : population.get_f()) {
    lowest = std::min(lowest, f[0]);
    highest = std::max(highest, f[0]);
  }
  return highest - lowest < 1e-12 * lowest;
}

}  // namespace

PagmoSettings TunedPagmo(Model model) {
  const int population = model == Model::kSingleDiode ? 30 : 50;
  return {population, 3000, 2, 30};
}

PeerEnd RunPagmo(const PeerProblem& problem, std::uint64_t seed, const PagmoSettings& settings) {
  constexpr unsigned kChunk = 20;  // generations between checks of the target
  double best = HUGE_VAL;
  std::int64_t evaluations = 0;
  for (int round = 0; round < settings.rounds && best > problem.target(); ++round) {
    const auto random = static_cast<unsigned>(1 + seed * settings.rounds + round);
    pagmo::population population(pagmo::problem(UnitBox{&problem}),
                                 static_cast<unsigned>(settings.population), random);
    const pagmo::algorithm evolution(
        pagmo::de1220(kChunk, pagmo::de1220_statics<void>::allowed_variants,
                      static_cast<unsigned>(settings.adaptation), 0.0, 0.0, true, random));
    for (int done = 0; done < settings.generations; done += kChunk) {
      population = evolution.evolve(population);
      if (population.champion_f()[0] <= problem.target() || StoodStill(population)) break;
    }
    best = std::min(best, population.champion_f()[0]);
    evaluations += static_cast<std::int64_t>(population.get_problem().get_fevals());
  }
  return {best, evaluations};
}

}  // namespace lyrefit::bench
