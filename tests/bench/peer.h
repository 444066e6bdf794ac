#pragma once

#include <cstdint>
#include <vector>

#include "bench_support.h"
#include "lyrefit/fit/search_space.h"

namespace lyrefit::bench {

// The fit as any optimisation library sees it: minimise the RMSE over the unit box. Same box, same
// logarithmic coordinates and same vector kernels as lyrefit's own search, so that methods are
// compared and not loops.
class PeerProblem {
 public:
  PeerProblem(const Case& subject, Model model, Objective objective);

  int dimensions() const { return space_.dimensions(); }
  // RMSE in mA, about 1 at the optimum.
  double Rmse(const double* unit) const;
  // Mean square in mA^2 and, where asked for, its gradient by the implicit function theorem.
  double MeanSquareAndGradient(const double* unit, double* gradient) const;
  // RMSE in mA at which a peer that is told the answer may stop. lyrefit is not told.
  double target() const { return target_; }

 private:
  void ToParameters(const double* unit, double* p) const;

  Device device_;
  PointSet points_;
  Objective objective_;
  SearchSpace space_;
  std::vector<double> side_;       // of the search space's box
  std::vector<bool> logarithmic_;  // sides that are searched in the logarithm
  double target_;
  mutable std::vector<double> x_;
  mutable std::vector<double> p_;
  mutable std::vector<Block> current_;
};

struct PeerEnd {
  double rmse_mA;
  std::int64_t evaluations;
};

struct NloptSettings {
  int population;           // of CRS2
  int global_evaluations;   // at most, of one CRS2 run
  double global_tolerance;  // ftol_rel that ends it
  int rounds;               // of CRS2 and SLSQP with fresh random numbers
  bool told;                // the answer, so that the first round to reach it is the last
};

// The cheapest settings found with which every run of seeds 0 to 49 ends within 1e-9, apart for
// each problem. Untold, that takes several rounds, since the single one often ends elsewhere.
NloptSettings TunedNlopt(Model model, Objective objective, bool told);

// One setting for every model and objective, as lyrefit has one: what the hardest of the six
// problems (two diodes, measured-current) asks for.
NloptSettings UniformNlopt(Model model);

// Controlled random search with local mutation (NLOPT_GN_CRS2_LM), then sequential quadratic
// programming from its best point (NLOPT_LD_SLSQP) with exact gradients.
PeerEnd RunNlopt(const PeerProblem& problem, std::uint64_t seed, const NloptSettings& settings);

struct PagmoSettings {
  int population;
  int generations;  // at most, of one round
  int adaptation;   // de1220's variant_adptv: 1 jDE, 2 iDE
  int rounds;       // at most, with fresh random numbers
};

// pagmo2's self-adaptive differential evolution (de1220), one population on one thread, told the
// answer and started afresh when it has converged elsewhere.
PagmoSettings TunedPagmo(Model model);
PeerEnd RunPagmo(const PeerProblem& problem, std::uint64_t seed, const PagmoSettings& settings);

}  // namespace lyrefit::bench
