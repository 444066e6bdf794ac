#pragma once

#include <memory>
#include <vector>

#include "lyrefit/law/device.h"
#include "lyrefit/law/kernel.h"

namespace lyrefit {

struct ErrorModel;
class LawWorkspace;

// A bounded least-squares problem on one curve: minimise the mean of weight x residual^2.
struct RefineProblem {
  Device device;
  Objective objective = Objective::kSolvedCurrent;
  std::vector<double> voltage_V;
  std::vector<double> current_A;
  std::vector<double> weights;  // of the squared residuals, mean 1
  // Where it is known how the errors hang together: in parts of `noise_A`, of weighted residuals,
  // which are whitened by it and then have noise_A as their standard deviation. None: independent.
  std::shared_ptr<const ErrorModel> errors;
  double noise_A = 0;
  std::vector<double> lower;  // of each parameter; lower == upper: fixed
  std::vector<double> upper;
  const Kernel* kernel = nullptr;
  PointSet points;  // the same points, laid out for the kernel

  // Natural sizes of the curve, which every coordinate is scaled by.
  double current_scale_A = 1;  // largest |current|
  double voltage_scale_V = 1;  // largest forward voltage; largest |voltage| if there is none
  double resistance_scale() const { return voltage_scale_V / current_scale_A; }
  bool fixed(int i) const { return lower[i] == upper[i]; }
};

// Fills what follows from the points: weights scaled to mean 1 (empty: all 1), the point set, the
// scales.
RefineProblem MakeRefineProblem(Device device, Objective objective, std::vector<double> voltage_V,
                                std::vector<double> current_A, std::vector<double> weights,
                                std::vector<double> lower, std::vector<double> upper);

// Residuals of the problem's own objective in ampere, weighted and whitened; where `slopes` is
// given, their derivatives by the device's parameters, row by row; by those that are fixed they may
// be 0. Of an extended device a workspace may be kept from one call to the next.
void Residuals(const RefineProblem& problem, const double* p, double* residuals, double* slopes,
               LawWorkspace* kept = nullptr);

// Mean square of them, in A^2.
double MeanSquare(const RefineProblem& problem, const std::vector<double>& p,
                  LawWorkspace* kept = nullptr);

}  // namespace lyrefit
