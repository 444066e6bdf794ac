#include "lyrefit/model/device.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/model/diode_residual.h"
#include "lyrefit/model/law.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

ParameterInfo SaturationInfo(std::string symbol, std::string name, std::string doc, int diode) {
  ParameterInfo info{std::move(symbol), std::move(name), "A", std::move(doc),
                     ParameterKind::kSaturation};
  info.with[0] = IdealityIndex(diode);
  return info;
}

}  // namespace

std::optional<int> Device::Find(const std::string& symbol_or_name) const {
  return FindParameter(parameters, symbol_or_name);
}

Device MakeDevice(Model model, const Conditions& conditions, ConstantSet constants) {
  Device device;
  device.module_thermal_voltage_V = conditions.ModuleThermalVoltage(constants);
  device.resistance_series = kRs;
  device.parameters = {
      {"Iph", "photocurrent", "A", "current the light generates", ParameterKind::kPhotocurrent},
      SaturationInfo("Is1", "saturation_current", "saturation current of the diode", 0),
      {"n1", "n", "", "ideality of the diode, per cell", ParameterKind::kIdeality},
      {"Rs", "resistance_series", "ohm", "series resistance of the whole device",
       ParameterKind::kSeries},
      {"Rsh", "resistance_shunt", "ohm", "shunt resistance of the whole device",
       ParameterKind::kShunt},
  };
  device.terms = {{TermKind::kPhotocurrent, {kIph, -1, -1}},
                  {TermKind::kShunt, {kRsh, -1, -1}},
                  {TermKind::kDiode, {SaturationCurrentIndex(0), IdealityIndex(0), -1}}};
  for (int diode = 1; diode < static_cast<int>(model); ++diode) {
    const std::string number = std::to_string(diode + 1);
    device.parameters.push_back(SaturationInfo("Is" + number, "saturation_current_" + number,
                                               "saturation current of diode " + number, diode));
    device.parameters.push_back({"n" + number, "n_" + number, "",
                                 "ideality of diode " + number + ", per cell",
                                 ParameterKind::kIdeality});
    device.terms.push_back(
        {TermKind::kDiode, {SaturationCurrentIndex(diode), IdealityIndex(diode), -1}});
  }
  return device;
}

void AddRecombination(Device* device) {
  const int first = device->size();
  device->parameters.push_back(
      {"d2mutau", "d2mutau", "V", "i-layer thickness squared over mobility times lifetime"});
  device->parameters.push_back({"NsVbi", "NsVbi", "V", "built-in voltage of all cells in series",
                                ParameterKind::kPlain, 10});
  device->terms.push_back({TermKind::kRecombination, {kIph, first, first + 1}});
}

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

DiodeResidual::DiodeResidual(const Device& device, Objective objective, double voltage_V,
                             double current_A, double weight)
    : size_(device.size()),
      objective_(objective),
      voltage_V_(voltage_V),
      current_A_(current_A),
      weight_(weight) {
  CHECK(device.effects == nullptr) << "a residual of one reading cannot have effects";
  CHECK_LE(size_, kMostParameters);
  device_.terms = device.terms;
  device_.resistance_series = device.resistance_series;
  device_.module_thermal_voltage_V = device.module_thermal_voltage_V;
}

DiodeResidual::Root DiodeResidual::Solve(const double* p) const {
  const OperatingPoint point = SolveOperatingPoint(device_, p, voltage_V_);
  return {point.current_A, point.junction_voltage_V, ImplicitFactor(device_, p, point)};
}

}  // namespace lyrefit
