#include <algorithm>
#include <cmath>

#include "lyrefit/model/cell.h"
#include "lyrefit/model/law.h"

namespace lyrefit {
namespace {

struct Bound {
  double lower;
  double upper;
};
// The photocurrent refers to 1000 W/m2: its bound admits curves down to 0.1 W/m2.
constexpr Bound kBaseBounds[] = {{0, 1.2e4}, {-60, 40}, {0.2, 8}, {0, 3}, {0, 50}, {0, 20}};
constexpr Bound kTempcoBound = {-0.01, 0.01}, kBandgapBound = {0.3, 2.5};

Bound BaseBound(const Law& law, int parameter) {
  if (law.free_bandgap && parameter == law.BandgapAt()) return kBandgapBound;
  if (law.free_tempco && parameter == law.TempcoAt()) return kTempcoBound;
  return kBaseBounds[parameter];
}

const EffectParameter* ParameterAt(const Law& law, int parameter) {
  int at = parameter - law.base_size();
  for (const Effect* effect : law.effects) {
    if (at < effect->size()) return &effect->parameters[at];
    at -= effect->size();
  }
  return nullptr;
}

}  // namespace

int Law::size() const {
  int size = base_size();
  for (const Effect* effect : effects) size += effect->size();
  return size;
}

int Law::Offset(int effect) const {
  int offset = base_size();
  for (int e = 0; e < effect; ++e) offset += effects[e]->size();
  return offset;
}

double Law::Lower(int parameter) const {
  if (parameter < base_size()) return BaseBound(*this, parameter).lower;
  return ParameterAt(*this, parameter)->lower;
}

double Law::Upper(int parameter) const {
  if (parameter < base_size()) return BaseBound(*this, parameter).upper;
  return ParameterAt(*this, parameter)->upper;
}

bool Law::Searched(int parameter) const {
  if (parameter < base_size()) return false;
  const EffectParameter* info = ParameterAt(*this, parameter);
  const auto is_it = [&](const auto& one) { return &one.first->parameters[one.second] == info; };
  return (info->searched || info->fixed_by_default) &&
         std::none_of(freed.begin(), freed.end(), is_it);
}

double SaturationCurrent(const Law&, const Readings& readings, const double* p) {
  const double vt = ThermalVoltage(readings.reference_temperature_K);
  return std::exp(p[kBasePivot]) / std::expm1(readings.pivot_voltage / (p[kBaseIdeality] * vt));
}

double Saturation2Unit(const Readings& readings) {
  return std::exp(-readings.pivot_voltage / (2 * ThermalVoltage(readings.reference_temperature_K)));
}

}  // namespace lyrefit
