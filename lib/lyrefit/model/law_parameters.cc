#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/law.h"

namespace lyrefit {

std::vector<ParameterInfo> Law::BaseInfos() const {
  std::vector<ParameterInfo> infos = MakeDevice(model, {}).parameters;
  if (free_tempco) infos.push_back({"alpha", "alpha_sc", "A/K", "temperature coefficient of Isc"});
  if (free_bandgap) infos.push_back({"Eg", "EgRef", "eV", "band gap at the reference"});
  return infos;
}

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

const EffectParameter* Law::EffectParameterAt(int parameter) const {
  int at = parameter - base_size();
  for (const Effect* effect : effects) {
    if (at < 0) break;
    if (at < effect->size()) return &effect->parameters[at];
    at -= effect->size();
  }
  return nullptr;
}

bool Law::Searched(int parameter) const {
  const EffectParameter* info = EffectParameterAt(parameter);
  if (info == nullptr) return false;
  const auto is_it = [&](const auto& one) { return &one.first->parameters[one.second] == info; };
  return (info->searched || info->fixed_by_default) &&
         std::none_of(freed.begin(), freed.end(), is_it);
}

double Saturation2Unit(const Readings& readings) {
  return std::exp(-readings.pivot_voltage / (2 * ThermalVoltage(readings.reference_temperature_K)));
}

}  // namespace lyrefit
