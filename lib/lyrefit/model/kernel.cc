#include "lyrefit/model/kernel.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "lyrefit/base/numbers.h"
#include "lyrefit/model/device_effects.h"

namespace lyrefit {

namespace portable {
extern const Kernel kKernel;
}
#if defined(__x86_64__)
namespace avx2 {
extern const Kernel kKernel;
}
namespace avx512 {
extern const Kernel kKernel;
}
#endif

namespace {

std::vector<Block> ToBlocks(const std::vector<double>& values, double filler) {
  std::vector<Block> blocks((values.size() + Block::kLanes - 1) / Block::kLanes);
  for (std::size_t i = 0; i < blocks.size() * Block::kLanes; ++i) {
    blocks[i / Block::kLanes].lane[i % Block::kLanes] = i < values.size() ? values[i] : filler;
  }
  return blocks;
}

std::vector<Kernel> FindKernels() {
  std::vector<Kernel> kernels = {portable::kKernel};
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2")) kernels.push_back(avx2::kKernel);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    kernels.push_back(avx512::kKernel);
  }
#endif
  return kernels;
}

}  // namespace

PreparedDevice Prepare(const Device& device, const double* p) {
  PreparedDevice prepared;
  const int count = static_cast<int>(device.terms.size());
  DCHECK_LE(count, PreparedDevice::kMaxTerms);
  PrepareDevice(device.terms.data(), count, device.resistance_series,
                device.module_thermal_voltage_V, p, &prepared);
  return prepared;
}

PointSet MakePointSet(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                      const std::vector<double>& weights) {
  CHECK(!voltage_V.empty());
  CHECK_EQ(voltage_V.size(), current_A.size());
  PointSet points;
  points.size = static_cast<int>(voltage_V.size());
  points.inverse_size = 1.0 / points.size;
  points.largest_voltage_V = *std::max_element(voltage_V.begin(), voltage_V.end());
  points.voltage_V = ToBlocks(voltage_V, voltage_V.back());
  points.current_A = ToBlocks(current_A, current_A.back());
  std::vector<double> scaled(voltage_V.size(), 1.0);
  if (!weights.empty()) {
    CHECK_EQ(weights.size(), voltage_V.size());
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      scaled[i] = weights[i] * (static_cast<double>(weights.size()) / sum);
    }
  }
  points.weight = ToBlocks(scaled, 0.0);
  return points;
}

const std::vector<Kernel>& AvailableKernels() {
  static const std::vector<Kernel> kernels = FindKernels();
  return kernels;
}

const Kernel& FastestKernel() { return AvailableKernels().back(); }

std::string KernelNames() {
  std::string names;
  for (const Kernel& kernel : AvailableKernels()) {
    names += std::string(names.empty() ? "" : ", ") + kernel.name;
  }
  return names;
}

Expected<const Kernel*> KernelNamed(const std::string& name) {
  for (const Kernel& kernel : AvailableKernels()) {
    if (name == kernel.name) return &kernel;
  }
  return Fail("this processor runs " + KernelNames() + ", not '" + name + "'");
}

namespace {

// Mean squared residual of a device with effects, with the weights of the kernels.
double ExtendedMeanSquare(const Device& device, Objective objective, const double* p,
                          const PointSet& points) {
  if (objective == Objective::kMeasuredCurrent) return kUnknown;  // no explicit right-hand side
  CHECK_EQ(points.size, static_cast<int>(device.effects->readings.points.size()));
  std::vector<double> current_A(points.size);
  if (!ExtendedCurrents(device, p, current_A.data(), nullptr)) return kUnknown;
  double sum = 0;
  for (int k = 0; k < points.size; ++k) {
    const int block = k / Block::kLanes, lane = k % Block::kLanes;
    const double residual = current_A[k] - points.current_A[block].lane[lane];
    sum += residual * residual * points.weight[block].lane[lane];
  }
  return sum * points.inverse_size;
}

}  // namespace

double MeanSquare(const Device& device, Objective objective, const double* p,
                  const PointSet& points, const Kernel& kernel) {
  if (device.effects != nullptr) return ExtendedMeanSquare(device, objective, p, points);
  const PreparedDevice prepared = Prepare(device, p);
  if (objective == Objective::kMeasuredCurrent) {
    return kernel.measured_mean_square(prepared, points);
  }
  return kernel.solved_mean_square(prepared, points,
                                   JunctionVoltageLimit(prepared, points.largest_voltage_V));
}

std::vector<double> SolveCurrents(const Device& device, const double* p, const PointSet& points,
                                  const Kernel& kernel) {
  if (device.effects != nullptr) {
    std::vector<double> current_A(device.effects->readings.points.size());
    CHECK_EQ(points.size, static_cast<int>(current_A.size()));
    const bool fine = ExtendedCurrents(device, p, current_A.data(), nullptr);
    return fine ? current_A : std::vector<double>(current_A.size(), std::nan(""));
  }
  const PreparedDevice prepared = Prepare(device, p);
  std::vector<Block> current(points.voltage_V.size());
  kernel.solve_currents(prepared, points, JunctionVoltageLimit(prepared, points.largest_voltage_V),
                        current.data());
  std::vector<double> result(points.size);
  std::memcpy(result.data(), current.data(), result.size() * sizeof(double));
  return result;
}

std::vector<double> SolveCurrents(const Device& device, const double* p,
                                  const std::vector<double>& voltage_V, const Kernel& kernel) {
  if (voltage_V.empty()) return {};
  if (device.effects != nullptr) return ExtendedCurrents(device, p, voltage_V);
  const std::vector<double> start(voltage_V.size(), Prepare(device, p).largest_current);
  return SolveCurrents(device, p, MakePointSet(voltage_V, start), kernel);
}

}  // namespace lyrefit
