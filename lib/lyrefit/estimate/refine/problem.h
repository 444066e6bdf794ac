#pragma once

#include <memory>
#include <vector>

#include "lyrefit/model/device.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/law.h"

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
  // Error model, if errors are correlated: in units of `noise_A`, for weighted residuals. It
  // whitens the residuals, which then have noise_A as their standard deviation. Null: independent
  // errors.
  std::shared_ptr<const ErrorModel> errors;
  double noise_A = 0;
  std::vector<double> lower;  // of each parameter; lower == upper: fixed
  std::vector<double> upper;
  const Kernel* kernel = nullptr;
  PointSet points;  // the points in the kernel's layout

  // Scales of the coordinates.
  double current_scale_A = 1;  // largest |current|
  double voltage_scale_V = 1;  // largest forward voltage; largest |voltage| if there is none
  double resistance_scale() const { return voltage_scale_V / current_scale_A; }
  bool fixed(int i) const { return lower[i] == upper[i]; }
};

// Computes the members that follow from the points: weights scaled to mean 1 (empty: all 1), the
// point set, the scales.
RefineProblem MakeRefineProblem(Device device, Objective objective, std::vector<double> voltage_V,
                                std::vector<double> current_A, std::vector<double> weights,
                                std::vector<double> lower, std::vector<double> upper);

// Residuals of the problem's objective in ampere, weighted and whitened. `slopes`, if not null:
// their derivatives by the device's parameters, row by row; those by fixed parameters may be 0. For
// a device with effects, a workspace may be reused between calls.
void Residuals(const RefineProblem& problem, const double* p, double* residuals, double* slopes,
               LawWorkspace* kept = nullptr);

// Mean square of the residuals, in A^2.
double MeanSquare(const RefineProblem& problem, const std::vector<double>& p,
                  LawWorkspace* kept = nullptr);

// Memory of this thread for blocks. The next call reuses it.
Block* ScratchBlocks(std::size_t size);

// The numbers of consecutive blocks, one after the other.
inline const double* NumbersOf(const Block* blocks) {
  return reinterpret_cast<const double*>(blocks);
}

// Model currents of an objective at every point: the explicit right-hand side at the measured
// current, or the solved current. `slopes`, if not null: derivatives by the device's parameters,
// row by row. Those of the solved current are those of the right-hand side at the root divided by 1
// - Rs F' (implicit function theorem). Differentiating the Newton iteration would cost more and be
// less exact. NaN if an equation with effects cannot be evaluated. Such an equation skips the
// derivatives by `fixed` parameters (1), which are then 0, and may reuse a workspace.
void ModelCurrents(const Device& device, Objective objective, const double* p,
                   const PointSet& points, const Kernel& kernel, double* current, double* slopes,
                   const std::vector<char>* fixed = nullptr, LawWorkspace* kept = nullptr);

}  // namespace lyrefit
