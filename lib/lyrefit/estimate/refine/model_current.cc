#include "lyrefit/estimate/refine/model_current.h"

#include <algorithm>
#include <cstring>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/solve.h"

namespace lyrefit {
namespace {

// Derivatives of a term's two prepared numbers by its at most three parameters.
using OfThree = Dual<3>;

PreparedTerm<OfThree> DifferentiateTerm(const Device& device, const Term& term, const double* p) {
  OfThree own[3];
  Term in_own{term.kind, {-1, -1, -1}};
  for (int k = 0; k < 3; ++k) {
    if (term.parameter[k] < 0) continue;
    own[k] = OfThree(p[term.parameter[k]], k);
    in_own.parameter[k] = k;
  }
  PreparedTerm<OfThree> prepared;
  PrepareTerm(in_own, own, device.module_thermal_voltage_V, &prepared);
  return prepared;
}

}  // namespace

Block* ScratchBlocks(std::size_t size) {
  thread_local std::vector<Block> blocks;
  if (blocks.size() < size) blocks.resize(size);
  return blocks.data();
}

void ModelCurrents(const Device& device, Objective objective, const double* p,
                   const PointSet& points, const Kernel& kernel, double* current, double* slopes,
                   const std::vector<char>* fixed, LawWorkspace* kept) {
  const bool measured = objective == Objective::kMeasuredCurrent;
  if (device.effects != nullptr) {
    if (measured || !ExtendedCurrents(device, p, current, slopes, fixed, kept)) {
      current[0] = kUnknown;
    }
    return;
  }
  const int size = points.size, count = device.size();
  const PreparedDevice prepared = Prepare(device, p);
  const std::size_t length = points.voltage_V.size();
  Block* const solved = ScratchBlocks((3 + 2 * prepared.count) * length);
  Block* const rows = solved + length;
  if (!measured) {
    kernel.solve_currents(prepared, points,
                          JunctionVoltageLimit(prepared, points.largest_voltage_V), solved);
    std::memcpy(current, solved, size * sizeof(double));
    if (slopes == nullptr) return;
  }
  const Block* const at = measured ? points.current_A.data() : solved;
  kernel.explicit_currents(prepared.terms, prepared.count, prepared.rs, points, at, rows);
  if (measured) std::memcpy(current, rows, size * sizeof(double));
  if (slopes == nullptr) return;
  const double* const currents = NumbersOf(at);
  const double* const conductance = NumbersOf(rows + length);
  std::fill(slopes, slopes + static_cast<std::ptrdiff_t>(size) * count, 0.0);
  for (int t = 0; t < prepared.count; ++t) {
    const Term& term = device.terms[t];
    const PreparedTerm<OfThree> number = DifferentiateTerm(device, term, p);
    const double* const by_a = NumbersOf(rows + (2 + 2 * t) * length);
    const double* const by_b = NumbersOf(rows + (3 + 2 * t) * length);
    for (int i = 0; i < 3 && term.parameter[i] >= 0; ++i) {
      double* to = slopes + term.parameter[i];
      for (int k = 0; k < size; ++k, to += count) {
        *to += by_a[k] * number.a.v[i] + by_b[k] * number.b.v[i];
      }
    }
  }
  for (int k = 0; k < size; ++k) {
    double* const row = slopes + static_cast<std::ptrdiff_t>(k) * count;
    row[device.resistance_series] += conductance[k] * currents[k];
    if (measured) continue;
    const double factor = 1 / (1 - prepared.rs * conductance[k]);
    for (int i = 0; i < count; ++i) row[i] *= factor;
  }
}

}  // namespace lyrefit
