#include "lyrefit/estimate/refine/model_current.h"

#include <algorithm>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/model/device_effects.h"

namespace lyrefit {
namespace {

// Derivatives by three variables: those of a term's two prepared numbers by its at most three
// parameters, and those of its current by these numbers and the junction voltage.
using OfThree = Dual<3>;

struct Sloped {
  Term term;
  PreparedTerm<OfThree> of_numbers;
  OfThree a, b;  // the prepared numbers as functions of the term's parameters
};

std::vector<Sloped> PrepareTerms(const Device& device, const double* p) {
  std::vector<Sloped> sloped;
  for (const Term& term : device.terms) {
    OfThree own[3];
    Term in_own{term.kind, {-1, -1, -1}};
    for (int k = 0; k < 3; ++k) {
      if (term.parameter[k] < 0) continue;
      own[k] = OfThree(p[term.parameter[k]], k);
      in_own.parameter[k] = k;
    }
    PreparedTerm<OfThree> prepared{};
    PrepareTerm(in_own, own, device.module_thermal_voltage_V, &prepared);
    sloped.push_back({term,
                      {term.kind, OfThree(prepared.a.a, 0), OfThree(prepared.b.a, 1)},
                      prepared.a,
                      prepared.b});
  }
  return sloped;
}

}  // namespace

void ModelCurrents(const Device& device, Objective objective, const double* p,
                   const CurveView& points, const Kernel& kernel, double* current, double* slopes,
                   const std::vector<char>* fixed, LawWorkspace* kept) {
  const bool measured = objective == Objective::kMeasuredCurrent;
  if (device.effects != nullptr) {
    if (measured || !ExtendedCurrents(device, p, current, slopes, fixed, kept)) {
      current[0] = kUnknown;
    }
    return;
  }
  const std::vector<double> at =
      measured ? points.current_A : SolveCurrents(device, p, points.set, kernel);
  std::copy(at.begin(), at.end(), current);
  if (!measured && slopes == nullptr) return;
  const std::vector<Sloped> terms = PrepareTerms(device, p);
  const int count = device.size();
  const double rs = p[device.resistance_series];
  std::vector<double> unused(count);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const OfThree vd(points.voltage_V[k] + at[k] * rs, 2);
    double* row = slopes != nullptr ? slopes + k * count : unused.data();
    std::fill(row, row + count, 0.0);
    double explicit_current = 0, conductance = 0;
    for (const Sloped& sloped : terms) {
      const OfThree part = TermCurrent(sloped.of_numbers, vd);
      explicit_current += part.a;
      conductance += part.v[2];
      for (int i = 0; i < 3 && sloped.term.parameter[i] >= 0; ++i) {
        row[sloped.term.parameter[i]] += part.v[0] * sloped.a.v[i] + part.v[1] * sloped.b.v[i];
      }
    }
    row[device.resistance_series] += conductance * at[k];
    if (measured) {
      current[k] = explicit_current;
      continue;
    }
    const double factor = 1 / (1 - rs * conductance);
    for (int i = 0; i < count; ++i) row[i] *= factor;
  }
}

}  // namespace lyrefit
