#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/parameter.h"
#include "lyrefit/model/term.h"

namespace LYREFIT_PUBLIC lyrefit {

// Number of diodes in parallel.
enum class Model { kSingleDiode = 1, kDoubleDiode = 2, kTripleDiode = 3 };

template <>
struct EnumTable<Model> {
  static constexpr EnumText<Model> kRows[] = {
      {Model::kSingleDiode, "sd"},
      {Model::kDoubleDiode, "dd"},
      {Model::kTripleDiode, "td"},
  };
};

// Which residual is squared. The two have different optima, so RMSE values of one must never be
// compared with those of the other:
//   measured-current  r = F(V, I_measured) - I_measured, the right-hand side at what was measured
//   solved-current    r = I(V) - I_measured, with I the root of I = F(V, I)
enum class Objective { kMeasuredCurrent, kSolvedCurrent };

template <>
struct EnumTable<Objective> {
  static constexpr EnumText<Objective> kRows[] = {
      {Objective::kMeasuredCurrent, "measured-current"},
      {Objective::kSolvedCurrent, "solved-current"},
  };
};

struct DeviceEffects;

// A device model: a sum of terms over the junction voltage, behind one series resistance. Parameter
// vectors are plain arrays in the order of `parameters`: Iph, Is1, n1, Rs, Rsh, then Is2, n2, Is3,
// n3. A model's vector therefore starts with the vector of the model with one diode less.
// AddRecombination appends its parameters at the end. Resistances are of the whole module, n is per
// cell.
struct Device {
  std::vector<ParameterInfo> parameters;
  std::vector<Term> terms;              // summed over the junction voltage
  int resistance_series = -1;           // position of Rs
  double module_thermal_voltage_V = 0;  // Ns Vt
  // Effects beside the diodes, and the measurement in which they act (device_effects.h). Their
  // parameters are the last ones. Null: no effects. Experimental, as its type is.
  std::shared_ptr<const DeviceEffects> effects;

  // Number of parameters.
  int size() const { return static_cast<int>(parameters.size()); }
  // Position of the parameter with this symbol ("Rs") or name ("resistance_series").
  std::optional<int> Find(const std::string& symbol_or_name) const;
};

// The single-, double- or triple-diode model of a device under these conditions.
Device MakeDevice(Model model, const Conditions& conditions,
                  ConstantSet constants = ConstantSet::kCodata);

// Appends PVsyst's recombination in the i-layer (TermKind::kRecombination). Its parameters d2mutau
// and NsVbi, both in volt, become the last ones. To be called once per device.
void AddRecombination(Device* device);

// Parameter positions that all models share.
constexpr int kIph = 0;
constexpr int kRs = 3;
constexpr int kRsh = 4;
constexpr int SaturationCurrentIndex(int diode) { return diode == 0 ? 1 : 3 + 2 * diode; }
constexpr int IdealityIndex(int diode) { return SaturationCurrentIndex(diode) + 1; }
// Number of diodes in parallel.
inline int DiodeCount(const Device& device) {
  int count = 0;
  for (const Term& term : device.terms) count += term.kind == TermKind::kDiode ? 1 : 0;
  return count;
}

// F(Vd): the current of all terms at junction voltage vd. T = S for automatic differentiation.
template <class S, class T>
T JunctionCurrent(const Device& device, const S* p, const T& vd) {
  T current = T(0.0);
  for (const Term& term : device.terms) {
    PreparedTerm<S> prepared{};
    PrepareTerm(term, p, device.module_thermal_voltage_V, &prepared);
    current = current + TermCurrent(prepared, vd);
  }
  return current;
}

// The right-hand side F(V + I Rs) at terminal voltage V and a given current I.
template <class S>
S ExplicitCurrent(const Device& device, const S* p, double voltage_V, double current_A) {
  return JunctionCurrent(device, p, S(voltage_V + current_A * p[device.resistance_series]));
}

}  // namespace lyrefit
