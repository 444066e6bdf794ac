#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/search_space.h"

namespace lyrefit {

// Maps candidates of the search to devices and their RMSE, on one set of points.
//
// A hard candidate (SearchVariables::kHard) has values of Rs, the n and the parameters of effects
// only. Iph, the saturation currents and 1/Rsh enter the law linearly or nearly so. Each evaluation
// solves for them within their bounds, so its value depends on the candidate alone:
//   measured current   by bounded linear least squares, exactly
//   solved current     by Levenberg-Marquardt steps, to 1e-6 of the sum of squares, from the linear
//                      solution or from a typical device with those n, whichever is lower
//   with effects       by Levenberg-Marquardt steps from the typical device
// With effects the inner problem may have several minima far from any fit; the one reached from the
// typical device counts. This is variable projection (Golub and Pereyra 1973, doi:10.1137/0710036).
class SearchCandidates {
 public:
  // `problem` is the problem of the job or its coarsened data.
  SearchCandidates(const FitJob& job, const RefineProblem& problem);

  // Stores starts in the box for the search, sorted by rank within their variant: the best of each
  // variant first, then the second of each. Costs one evaluation each.
  void Suggest(const std::vector<PolishStart>& starts);
  // Error if the box has no dimension.
  Expected<void> Check() const;
  const Box& box() const { return box_; }
  int VariantAt(const double* x) const { return space_.VariantAt(x); }

  // Complete parameters of a candidate, and its RMSE in the objective of the fit, in ampere.
  std::vector<double> DeviceAt(const double* x);
  double RmseAt(const double* x);
  // Evaluations of all points so far, with or without derivatives.
  std::int64_t evaluations() const { return evaluations_; }

 private:
  double SolveEasy();
  double Descend();

  const RefineProblem& problem_;
  bool hard_ = false;
  SearchSpace space_;
  Box box_;
  int effects_ = 0;     // number of parameters of effects
  RefineProblem easy_;  // for hard candidates: all other parameters fixed
  std::vector<double> p_;
  std::int64_t evaluations_ = 0;
};

// Search space of complete devices.
SearchSpace CompleteSpace(const FitJob& job);

}  // namespace lyrefit
