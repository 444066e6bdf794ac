#pragma once

#include <cstdint>
#include <vector>

#include "bench_support.h"
#include "lyrefit/estimate/fit/search_space.h"

namespace lyrefit::bench {

// The fit as a problem for any optimization library: minimise the RMSE over the unit box. Box,
// logarithmic coordinates and vector kernels are those of lyrefit's own search, so that only the
// methods differ.
class PeerProblem {
 public:
  PeerProblem(const Case& subject, Model model, Objective objective);

  int dimensions() const { return space_.dimensions(); }
  // RMSE in mA, about 1 at the optimum.
  double Rmse(const double* unit) const;
  // Mean square in mA^2 and, unless `gradient` is null, its gradient by the implicit function
  // theorem.
  double MeanSquareAndGradient(const double* unit, double* gradient) const;
  // RMSE in mA at which a peer with the flag `told` may stop; lyrefit never gets it.
  double target() const { return target_; }

 private:
  void ToParameters(const double* unit, double* p) const;

  Device device_;
  PointSet points_;
  Objective objective_;
  SearchSpace space_;
  std::vector<double> side_;       // side lengths of the search box
  std::vector<bool> logarithmic_;  // sides on a logarithmic scale
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
  int global_evaluations;   // upper limit for one CRS2 run
  double global_tolerance;  // ftol_rel at which CRS2 ends
  int rounds;               // of CRS2 and SLSQP, with new random numbers
  bool told;                // stop in the first round that reaches the optimum
};

// The fastest settings found for each problem with which every run of seeds 0 to 49 ends within
// 1e-9 of the optimum. Unless `told`, this takes several rounds, since a single round often ends
// elsewhere.
NloptSettings TunedNlopt(Model model, Objective objective, bool told);

// One setting for every model and objective, as for lyrefit: the setting that the hardest of the
// six problems (two diodes, measured-current) needs.
NloptSettings UniformNlopt(Model model);

// Controlled random search with local mutation (NLOPT_GN_CRS2_LM), then sequential quadratic
// programming from its best point (NLOPT_LD_SLSQP) with exact gradients.
PeerEnd RunNlopt(const PeerProblem& problem, std::uint64_t seed, const NloptSettings& settings);

struct PagmoSettings {
  int population;
  int generations;  // upper limit for one round
  int adaptation;   // de1220's variant_adptv: 1 jDE, 2 iDE
  int rounds;       // upper limit, with new random numbers
};

// pagmo2's self-adaptive differential evolution (de1220) with one population on one thread. It
// stops at the optimum, and is restarted when it has converged elsewhere.
PagmoSettings TunedPagmo(Model model);
PeerEnd RunPagmo(const PeerProblem& problem, std::uint64_t seed, const PagmoSettings& settings);

}  // namespace lyrefit::bench
