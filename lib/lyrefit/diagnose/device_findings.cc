#include "lyrefit/diagnose/device_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/diagnose/verdict.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/fit/usable.h"

namespace lyrefit {
namespace {

enum class DeviceClass { kSiliconModule, kSiliconCell, kThinFilm };
enum class JudgedQuantity { kLeak, kSeriesResistance };

// Largest values of devices without a fault under standard light. Of silicon modules simulated cell
// by cell, 1 of 72 without a fault exceeds one of them, and 24 of 30 that were degraded. Single cells
// and thin films vary more, and a slope at 0 V may be collection that depends on the voltage, so that
// their limits are wide.
struct HealthyLimit {
  JudgedQuantity quantity;
  DeviceClass kind;
  double limit;
  const char* source;
};
constexpr HealthyLimit kHealthyLimits[] = {
    {JudgedQuantity::kLeak, DeviceClass::kSiliconModule, 0.016, "72 modules without a fault"},
    {JudgedQuantity::kLeak, DeviceClass::kSiliconCell, 0.03,
     "twice that of modules, whose cells are sorted"},
    {JudgedQuantity::kLeak, DeviceClass::kThinFilm, 0.25,
     "doi:10.1038/ncomms7951: no shunt, poor collection"},
    {JudgedQuantity::kSeriesResistance, DeviceClass::kSiliconModule, 0.11,
     "eight new modules, 0.04 to 0.075, and 0.03 more"},
    {JudgedQuantity::kSeriesResistance, DeviceClass::kSiliconCell, 0.14, "as of modules"},
    {JudgedQuantity::kSeriesResistance, DeviceClass::kThinFilm, 0.25,
     "twice that of modules: contact layers"},
};

// Cells of modules are sorted; others have what is usual of their technology.
double LimitOfIdeality(const std::string& technology, const DeviceClass kind) {
  if (kind == DeviceClass::kSiliconModule) return 1.25;  // 72 modules without a fault
  const Technology* const known = FindTechnology(technology);
  const Technology& film = *FindTechnology("CIGS");
  const Technology& of = known != nullptr                 ? *known
                         : kind == DeviceClass::kThinFilm ? film
                                                          : Silicon();
  return of.junctions * of.most_ideality;
}

double LimitOf(JudgedQuantity quantity, DeviceClass kind) {
  for (const HealthyLimit& row : kHealthyLimits) {
    if (row.quantity == quantity && row.kind == kind) return row.limit;
  }
  return kUnknown;
}

DeviceClass ClassOf(const std::string& technology, const DataTraits& traits) {
  if (IsThinFilm(technology)) return DeviceClass::kThinFilm;
  return traits.module ? DeviceClass::kSiliconModule : DeviceClass::kSiliconCell;
}

// The extended fit, with what the quantities under standard light need.
struct JudgedDevice {
  const WeightedData& weighted;
  const LawFit& fit;
  DeviceClass of;
  std::string technology;
  double voltage_V;  // open circuit under standard light
  double current_A;  // short circuit under standard light
  std::vector<double> errors;
  double spread;  // half of a 95 % interval in standard errors
};

JudgedDevice JudgeDevice(const Selection& selection, const DeviceKind& kind) {
  const WeightedData& weighted = selection.weighted;
  const LawFit& fit = selection.extended;
  const Readings& readings = *weighted.readings;
  const DataTraits& traits = readings.traits;
  double light = 0;
  for (const Reading& reading : readings.points) light = std::max(light, reading.irradiance);
  const double measured = traits.open_circuit > 0 ? traits.open_circuit : readings.pivot_voltage;
  const double thermal = ThermalVoltage(readings.reference_temperature_K);
  const double to_standard = kind.irradiance_known ? -Ideality(fit) * thermal * std::log(light) : 0;
  return {weighted,
          fit,
          ClassOf(kind.technology, traits),
          kind.technology,
          (measured + to_standard) * readings.scale.cells,
          kind.irradiance_known ? fit.p[kIph] : fit.p[kIph] * light,
          StandardErrors(Linearize(weighted, fit)),
          StudentT95(Degrees(weighted, fit.law)) * std::sqrt(NoiseVariance(weighted, fit))};
}

// Part of Pmax that the device lacks against the same device with another value of a parameter.
// The current of the diode at open circuit stays what it is.
double LossAgainst(const JudgedDevice& device, int parameter, double value) {
  const LawCoordinates coordinates(device.fit.law, *device.weighted.readings);
  LawFit healthy = device.fit;
  healthy.p[parameter] = value;
  const double coordinate = coordinates.Of(healthy.p)[parameter];
  std::vector<double> theta = coordinates.Of(device.fit.p);
  theta[parameter] = coordinate;
  healthy.p = coordinates.Parameters(theta);
  return 1 - DevicePower(device.weighted, device.fit) / DevicePower(device.weighted, healthy);
}

Sized About(double value, double half) {
  return {value, std::max(value - half, 0.0), value + half};
}

// Watts of a part of Pmax that the device lacks against another with the limit of a parameter. Within
// the interval of the parameter they go with its distance from the limit.
Sized Watts(const JudgedDevice& device, double loss, const Sized& value, double limit) {
  const double watts = DevicePower(device.weighted, device.fit) * loss / (1 - loss);
  const auto at = [&](double other) { return watts * (other - limit) / (value.value - limit); };
  return {watts, at(value.low_95), at(value.high_95)};
}

bool IsAbove(const Sized& value, double limit) { return value.low_95 > limit; }

// "twice what modules do (at most 1.6 %)"
std::string Exceeding(const JudgedDevice& device, double ratio, const char* what,
                      const std::string& limit) {
  const char* const others = device.of == DeviceClass::kSiliconModule ? "modules"
                             : device.of == DeviceClass::kSiliconCell ? "cells"
                                                                      : "thin films";
  const std::string more = ratio < 1.75   ? "more than"
                           : ratio < 2.25 ? "twice what"
                                          : fmt::format("{:.2g} times what", ratio);
  return fmt::format("{} healthy {} {} (at most {})", more, others, what, limit);
}

// ", which takes 4.0 % of Pmax"
std::string LossText(double loss) {
  return fmt::format(", which {} {:.1f} % of Pmax", loss < 0 ? "adds" : "takes",
                     100 * std::fabs(loss));
}

void AddLeak(const JudgedDevice& device, std::vector<DeviceFinding>* findings) {
  const double resistance = device.fit.p[kRsh];
  if (!std::isfinite(resistance)) return;
  const double limit = LimitOf(JudgedQuantity::kLeak, device.of);
  const double value = device.voltage_V / (resistance * device.current_A);
  const Sized leak = About(value, value * device.spread * device.errors[kRsh] / resistance);
  if (!IsAbove(leak, limit)) return;
  const double healthy = device.voltage_V / (limit * device.current_A);
  const double loss = LossAgainst(device, kRsh, healthy);
  const char* const causes =
      device.of == DeviceClass::kSiliconModule
          ? "potential-induced degradation, a shunted cell or an edge"
          : "a shunt, or collection that depends on the voltage; a dark curve decides";
  findings->push_back(
      {"leak", "Voc/(Rsh Isc)", leak, limit, loss,
       fmt::format("leaks {:.1f} % ({:.1f} to {:.1f}) of Isc at Voc, {}{}; {}", 100 * leak.value,
                   100 * leak.low_95, 100 * leak.high_95,
                   Exceeding(device, value / limit, "do", fmt::format("{:.2g} %", 100 * limit)),
                   LossText(loss), causes),
       false, Watts(device, loss, leak, limit)});
}

double CellVoltage(const JudgedDevice& device) {
  return device.voltage_V / device.weighted.readings->scale.cells;
}

// Whether nobody states the technology and another one than silicon has such an ideality: the voltage
// a cell is none that silicon has under standard light, whose modules have 0.57 V and more, or n is
// above that of all its cells.
bool MayBeAnother(const JudgedDevice& device, const Sized& n) {
  constexpr double kLeastOfSilicon_V = 0.56;
  const double cell_V = CellVoltage(device);
  const bool of_silicon = cell_V > kLeastOfSilicon_V && cell_V < Silicon().most_Voc_V &&
                          !IsAbove(n, Silicon().most_ideality);
  return device.technology.empty() && !of_silicon &&
         !IsAbove(n, FindTechnology("CIGS")->most_ideality);
}

void AddIdeality(const JudgedDevice& device, std::vector<DeviceFinding>* findings) {
  if (device.fit.law.model != Model::kSingleDiode) return;  // n1 is then of one of two
  const int index = IdealityIndex(0);
  const double limit = LimitOfIdeality(device.technology, device.of);
  const Sized n = About(device.fit.p[index], device.spread * device.errors[index]);
  if (!IsAbove(n, limit)) return;
  const double loss = LossAgainst(device, index, limit);
  if (MayBeAnother(device, n)) {
    findings->push_back(
        {"ideality", "n", n, limit, loss,
         fmt::format(
             "has n = {:.2f} ({:.2f} to {:.2f}) at {:.2g} V a cell: of silicon that would be "
             "{}{}; CIGS, CdTe, a-Si, organic and perovskite devices have up to {:.3g} "
             "without a fault: state the technology (--technology)",
             n.value, n.low_95, n.high_95, CellVoltage(device),
             Exceeding(device, 1, "have", fmt::format("{:.3g}", limit)), LossText(loss),
             FindTechnology("CIGS")->most_ideality),
         true, Watts(device, loss, n, limit)});
    return;
  }
  // Recombination in a junction ends at n = 2.
  constexpr double kMostOfJunctions = 2;
  const char* const causes =
      n.value > kMostOfJunctions && device.of != DeviceClass::kThinFilm
          ? "more than of any junction: unequal or shunted cells, light that changes, or a number "
            "of cells not as stated"
          : "recombination in aged cells, or a temperature or a number of cells not as stated";
  findings->push_back(
      {"ideality", "n", n, limit, loss,
       fmt::format("has n = {:.2f} ({:.2f} to {:.2f}), {}{}; {}", n.value, n.low_95, n.high_95,
                   Exceeding(device, 1, "have", fmt::format("{:.3g}", limit)), LossText(loss),
                   causes),
       false, Watts(device, loss, n, limit)});
}

void AddLowIdeality(const JudgedDevice& device, std::vector<DeviceFinding>* findings) {
  const int index = IdealityIndex(0);
  const Sized n = About(device.fit.p[index], device.spread * device.errors[index]);
  const bool at_bound = !(device.errors[index] > 0);  // the readings do not tell it
  if (at_bound || !(n.high_95 < LeastIdeality(device.weighted))) return;
  findings->push_back(
      {"ideality", "n", n, 1, kUnknown,
       fmt::format("has n = {:.2f} ({:.2f} to {:.2f}), less than any junction has; the number of "
                   "cells or the temperature is not as stated, or the model lacks a cause",
                   n.value, n.low_95, n.high_95),
       false, Sized()});
}

void AddSeriesResistance(const JudgedDevice& device, std::vector<DeviceFinding>* findings) {
  const double limit = LimitOf(JudgedQuantity::kSeriesResistance, device.of);
  const double scale = device.current_A / device.voltage_V;
  const Sized drop = About(device.fit.p[kRs] * scale, device.spread * device.errors[kRs] * scale);
  if (!IsAbove(drop, limit)) return;
  const double loss = LossAgainst(device, kRs, limit / scale);
  findings->push_back(
      {"series_resistance", "Rs Isc/Voc", drop, limit, loss,
       fmt::format(
           "drops {:.1f} % ({:.1f} to {:.1f}) of Voc in its series resistance at Isc, "
           "{}{}; {}",
           100 * drop.value, 100 * drop.low_95, 100 * drop.high_95,
           Exceeding(device, drop.value / limit, "do", fmt::format("{:.2g} %", 100 * limit)),
           LossText(loss),
           device.of == DeviceClass::kSiliconModule
               ? "corroded contacts, a broken ribbon, connectors or long leads"
               : "contacts, a resistive layer or leads"),
       false, Watts(device, loss, drop, limit)});
}

}  // namespace

bool ReachesPastKnee(const Readings& readings) {
  constexpr double kPast = 0.6;  // of the largest current
  for (const Reading& reading : readings.points) {
    if (!reading.dark && reading.current < kPast &&
        reading.voltage > 0.5 * readings.pivot_voltage) {
      return true;
    }
  }
  return false;
}

std::vector<DeviceFinding> FindDeviceFindings(const Selection& selection, const DeviceKind& kind,
                                              const std::vector<Cause>& causes,
                                              const Floors& floors) {
  constexpr double kSmallestFloor = 0.0025;
  const Readings& readings = *selection.weighted.readings;
  const DataTraits& traits = readings.traits;
  if (traits.only_dark || !traits.single || !ReachesPastKnee(readings)) return {};
  if (LeftBy(selection.weighted, selection.extended).value >
      std::max(floors.current, kSmallestFloor)) {
    return {};
  }
  // Readings with so much noise tell nothing of the device, and no fit of them is usable.
  if (RmseOf(selection.weighted, selection.extended.current) >
      kLargestMisfit * readings.scale.current_A) {
    return {};
  }
  const JudgedDevice device = JudgeDevice(selection, kind);
  if (!(device.voltage_V > 0 && device.current_A > 0)) return {};
  // More than any string of cells gives: the stated irradiance is wrong.
  constexpr double kMostCurrent_A = 25;
  const bool light_known =
      kind.irradiance_known && (device.current_A < kMostCurrent_A || readings.scale.strings > 1);
  std::vector<DeviceFinding> findings;
  // Parts of the current and of the voltage under standard light are known only where the light is.
  if (light_known) AddLeak(device, &findings);
  // n of one direction of a hysteretic cell is no ideality.
  const bool by_sweep = std::any_of(causes.begin(), causes.end(), [](const Cause& cause) {
    const Effect* effect = FindEffect(cause.effect);
    return effect != nullptr && effect->by_sweep;
  });
  if (!by_sweep) AddIdeality(device, &findings);
  if (light_known) AddSeriesResistance(device, &findings);
  constexpr double kSmallestLoss = 0.01;  // below it sound modules differ as much
  const double least = std::max(floors.power, kSmallestLoss);
  findings.erase(std::remove_if(findings.begin(), findings.end(),
                                [least](const DeviceFinding& finding) {
                                  return !(finding.power_loss > least);
                                }),
                 findings.end());
  std::stable_sort(
      findings.begin(), findings.end(),
      [](const DeviceFinding& a, const DeviceFinding& b) { return a.power_loss > b.power_loss; });
  if (causes.empty()) AddLowIdeality(device, &findings);  // a cause may change n
  return findings;
}

void AddFillFactor(const std::optional<FillFactor>& fill_factor, const std::vector<Cause>& causes,
                   std::vector<DeviceFinding>* findings) {
  constexpr double kMostOfIt = 0.5;
  if (!fill_factor || !IsLow(*fill_factor) || !causes.empty()) return;
  const FillFactor& fill = *fill_factor;
  for (const DeviceFinding& finding : *findings) {
    if (finding.power_loss > kMostOfIt * fill.lost.value) return;
  }
  findings->insert(
      findings->begin(),
      {"fill_factor", "FF", fill.value, fill.least, fill.lost.value,
       fmt::format(
           "has a fill factor of {:.3f}; modules of silicon without a fault have {:.3f} at "
           "this voltage, {:.3f} at least: {:.0f} % of Pmax ({:.0f} to {:.0f}) is missing. "
           "Aged contacts, shunts, recombination and weak cells draw such curves; a Suns-Voc "
           "trace or a dark curve tells them apart",
           fill.value.value, fill.usual, fill.least, 100 * fill.lost.value, 100 * fill.lost.low_95,
           100 * fill.lost.high_95),
       fill.if_silicon, fill.lost_W});
}

}  // namespace lyrefit
