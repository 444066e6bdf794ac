// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/pack.h"
#include "lyrefit/model/solve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Points of a curve in blocks for the kernels. Copies of the last point at weight 0 fill the last
// block.
struct PointSet {
  int size = 0;             // points
  double inverse_size = 0;  // 1 / size
  double largest_voltage_V = 0;
  std::vector<Block> voltage_V;
  std::vector<Block> current_A;
  std::vector<Block> weight;  // of the squared residual, mean 1
};

// `weights` may be empty (all 1) or as long as the points; it is scaled to mean 1.
PointSet MakePointSet(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                      const std::vector<double>& weights = {});

// The voltage-independent part of a device without effects at parameters `p`.
PreparedDevice Prepare(const Device& device, const double* p);

// The inner loops, compiled once per instruction set from one source. They use no fused
// multiply-add and a fixed order of summation, so all kernels give the same bits for the same
// input.
struct Kernel {
  const char* name;  // "portable", "avx2", "avx512"
  // Mean of weight x (F(V, I) - I)^2, A^2.
  double (*measured_mean_square)(const PreparedDevice&, const PointSet&);
  // Mean of weight x (I(V) - I)^2, A^2. `diode_limit`: JunctionVoltageLimit at the largest voltage.
  double (*solved_mean_square)(const PreparedDevice&, const PointSet&, double diode_limit);
  // Writes I(V) of every point to `current`, which has as many blocks as the set. The set's
  // currents are its starts.
  void (*solve_currents)(const PreparedDevice&, const PointSet&, double diode_limit,
                         Block* current);
  // Writes the sum of terms F(V + `rs` I) at the currents I and its derivatives to `rows`, which
  // are as many blocks as the set each: F, dF/dVd, then dF/da and dF/db of each term.
  void (*explicit_currents)(const PreparedTerm<double>* terms, int count, double rs,
                            const PointSet&, const Block* current, Block* rows);
};

// Every kernel this processor can run, slowest ("portable") first.
const std::vector<Kernel>& AvailableKernels();
const Kernel& FastestKernel();
std::string KernelNames();  // "portable, avx2"
// Errors: no such kernel, or one this processor cannot run.
Expected<const Kernel*> KernelNamed(const std::string& name);

// Mean squared residual of parameters `p` (device.size() of them) in A^2; the RMSE is its root. For
// a device with effects (device_effects.h) the points must be those of its measurement, and the
// measured-current residual is NaN.
double MeanSquare(const Device& device, Objective objective, const double* p,
                  const PointSet& points, const Kernel& kernel = FastestKernel());

// I(V) in ampere at the voltages of `points`, in their order.
std::vector<double> SolveCurrents(const Device& device, const double* p, const PointSet& points,
                                  const Kernel& kernel = FastestKernel());

// I(V) in ampere at plain voltages. For a device with effects they are one sweep in this order.
std::vector<double> SolveCurrents(const Device& device, const double* p,
                                  const std::vector<double>& voltage_V,
                                  const Kernel& kernel = FastestKernel());

}  // namespace lyrefit
