#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/diagnose/score.h"
#include "lyrefit/diagnose/workbench.h"

namespace lyrefit {

// An effect on its bench: its own part of a score, and how it would show in noise.
struct Candidate {
  Score score;
  bool two_sided = false;
  Eigen::MatrixXf directions;  // unit columns that no two are alike; none for outliers
};

// A law's candidates.
struct Prepared {
  Linearized linear;
  int degrees = 0;  // of the readings beyond the law's parameters
  std::vector<Candidate> candidates;
};

Prepared PrepareAll(const Workbench& bench, const LawFit& fit,
                    const std::vector<const Effect*>& effects);

// F(1, degrees - 1) of a score that takes its square off a sum of squares.
double Statistic(double score, double sum, int degrees, double least_variance);

}  // namespace lyrefit
