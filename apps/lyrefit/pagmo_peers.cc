#ifdef LYREFIT_HAS_PAGMO

#include "pagmo_peers.h"

#include <algorithm>
#include <limits>
#include <pagmo/algorithms/bee_colony.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/algorithms/gaco.hpp>
#include <pagmo/algorithms/gwo.hpp>
#include <pagmo/algorithms/ihs.hpp>
#include <pagmo/algorithms/pso.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/sea.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/algorithms/simulated_annealing.hpp>
#include <pagmo/algorithms/xnes.hpp>

namespace lyrefit {
namespace {

constexpr unsigned kNever = std::numeric_limits<unsigned>::max();

// The temperature falls from the objective of the first candidates by four decades in ten steps,
// with ten range adjustments in each. The rest of the budget goes into the length of a step.
pagmo::algorithm MakeAnnealing(const PagmoPlan& plan) {
  constexpr std::int64_t kSteps = 10, kRanges = 10;
  const std::int64_t bin = plan.evaluations / (kSteps * kRanges * plan.dimensions);
  const auto bin_size = static_cast<unsigned>(std::clamp<std::int64_t>(bin, 1, 1000000000));
  return pagmo::algorithm(pagmo::simulated_annealing(plan.level, 1e-4 * plan.level, kSteps, kRanges,
                                                     bin_size, 1.0, plan.seed));
}

pagmo::algorithm MakeAntColony(const PagmoPlan& plan) {
  return pagmo::algorithm(pagmo::gaco(plan.generations, std::min(63U, plan.population), 1.0, 0.0,
                                      0.01, 1, 7, kNever, kNever, 0.0, false, plan.seed));
}

using pagmo::algorithm;

}  // namespace

const std::vector<PagmoPeer>& PagmoPeers() {
  static const std::vector<PagmoPeer> peers = {
      {"de", 1, 0,
       [](const PagmoPlan& p) {
         return algorithm(pagmo::de(p.generations, 0.8, 0.9, 2, 0, 0, p.seed));
       }},
      {"sade", 1, 0,
       [](const PagmoPlan& p) {
         return algorithm(pagmo::sade(p.generations, 2, 1, 0, 0, false, p.seed));
       }},
      {"de1220", 1, 0,
       [](const PagmoPlan& p) {
         const auto& variants = pagmo::de1220_statics<void>::allowed_variants;
         return algorithm(pagmo::de1220(p.generations, variants, 1, 0, 0, false, p.seed));
       }},
      {"cmaes", 1, 0,
       [](const PagmoPlan& p) {
         return algorithm(
             pagmo::cmaes(p.generations, -1, -1, -1, -1, 0.5, 0, 0, false, true, p.seed));
       }},
      {"xnes", 1, 0,
       [](const PagmoPlan& p) {
         return algorithm(pagmo::xnes(p.generations, -1, -1, -1, -1, 0, 0, false, true, p.seed));
       }},
      {"pso", 1, 0,
       [](const PagmoPlan& p) {
         return algorithm(
             pagmo::pso(p.generations, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, false, p.seed));
       }},
      {"pso_gen", 1, 0,
       [](const PagmoPlan& p) {
         return algorithm(
             pagmo::pso_gen(p.generations, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, false, p.seed));
       }},
      {"gwo", 1, 0,
       [](const PagmoPlan& p) { return algorithm(pagmo::gwo(p.generations, p.seed)); }},
      {"bee_colony", 2, 0,
       [](const PagmoPlan& p) { return algorithm(pagmo::bee_colony(p.generations, 20, p.seed)); }},
      {"gaco", 1, 0, MakeAntColony},
      {"sga", 1, 0,
       [](const PagmoPlan& p) {
         return algorithm(pagmo::sga(p.generations, 0.9, 1, 0.02, 1, 2, "exponential", "polynomial",
                                     "tournament", p.seed));
       }},
      {"ihs", 0, 1,
       [](const PagmoPlan& p) {
         return algorithm(pagmo::ihs(p.generations, 0.85, 0.35, 0.99, 1e-5, 1, p.seed));
       }},
      {"sea", 0, 1,
       [](const PagmoPlan& p) { return algorithm(pagmo::sea(p.generations, p.seed)); }},
      {"simulated_annealing", 0, 1, MakeAnnealing},
  };
  return peers;
}

}  // namespace lyrefit

#endif  // LYREFIT_HAS_PAGMO
