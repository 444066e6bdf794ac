#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/search_space.h"

namespace lyrefit {

// What the candidates of a fit's search stand for, on one set of points.
//
// A hard candidate (Candidates::kHard) is a place in Rs, the n and the effects' parameters. Iph, the
// saturation currents and 1/Rsh, which the law is linear in or nearly so, are solved for between
// their bounds within each evaluation, so its value depends on the place alone:
//   measured current   by bounded linear least squares, exactly
//   solved current     by Levenberg-Marquardt steps, to 1e-6 of the sum of squares, from there or
//                      from a typical device of those n, whichever is lower
//   with effects       by the same steps from the typical device
// With effects the rest may have several minima where the place is far from any fit; the one that
// the typical device leads to counts.
// This is variable projection (Golub and Pereyra 1973, doi:10.1137/0710036).
class SearchCandidates {
 public:
  // Of the points of `problem`: those of the job, or the few that stand for them.
  SearchCandidates(const FitJob& job, const RefineProblem& problem);

  // Puts places into the box that a search may begin from: the best of each variant first, then the
  // second of each. One evaluation each.
  void Suggest(const std::vector<PolishStart>& starts);
  // Whether the box has a side.
  Expected<void> Check() const;
  const Box& box() const { return box_; }
  int VariantAt(const double* x) const { return space_.VariantAt(x); }

  // The complete device of a candidate, and its RMSE in the objective of the fit.
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
  int effects_ = 0;     // parameters of effects
  RefineProblem easy_;  // of hard candidates: all others held
  std::vector<double> p_;
  std::int64_t evaluations_ = 0;
};

// The box of complete devices.
SearchSpace CompleteSpace(const FitJob& job);

}  // namespace lyrefit
