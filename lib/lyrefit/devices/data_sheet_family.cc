#include "lyrefit/devices/data_sheet_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lyrefit/base/roots.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/data_sheet_values.h"
#include "lyrefit/devices/data_sheet_parts.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

// Of Voc / (n Ns Vt): the diode law clips larger exponents. n = 1 has about 25.
constexpr double kLargestSheetExponent = 200;
// Of Voc / (n Ns Vt): no sheet has a member with a smaller one.
constexpr double kSmallestExponent = 0.01;
constexpr double kExponentStep = 1.05;
constexpr int kMembers = 32;
constexpr std::size_t kVoltages = 400;  // steps from 0 V to Voc at which curves are compared
constexpr MemberConditions kConditions[] = {{200, 25}, {1000, 50}, {1000, 75}};

// The last member, from n bisected between `inside` and `outside` to the last bit. The quantity
// that ends the family (`bound`) is set to exactly 0.
KeyPointCurve LastCurve(const KeyPointSheet& sheet, double inside, double outside,
                        FamilyBound* bound) {
  const auto member = [&](double n) { return PhysicalCurve(sheet, n) ? 1.0 : -1.0; };
  const double last = SignChange(member, inside, outside);
  const double near[] = {std::max(inside, last * (1 - 1e-7)), last * (1 + 1e-7)};
  const auto no_series = [&](double n) { return CurveThrough(sheet, n, 0); };
  const auto slope = [&](double n) { return no_series(n).slope_error; };
  if ((slope(near[0]) > 0) != (slope(near[1]) > 0)) {
    *bound = FamilyBound::kSeriesResistance;
    const KeyPointCurve curve = no_series(SignChange(slope, near[0], near[1]));
    if (curve.conductance >= 0) return curve;
  }
  *bound = FamilyBound::kShuntConductance;
  const double most = LargestResistance(sheet);
  const auto no_shunt = [&](double n) {
    const auto conductance = [&](double rs) { return CurveThrough(sheet, n, rs).conductance; };
    return CurveThrough(sheet, n, SignChange(conductance, 0, most));
  };
  const auto slope_there = [&](double n) { return no_shunt(n).slope_error; };
  KeyPointCurve curve = no_shunt(SignChange(slope_there, near[0], near[1]));
  curve.conductance = 0;
  return curve;
}

// The broken line has the slopes (Isc - Imp) / Vmp and then Imp / (Voc - Vmp).
SharpKnee KneeOf(const DataSheetValues& v) {
  const double rs = (v.open_circuit_voltage_V - v.max_power_voltage_V) / v.max_power_current_A;
  const double fall = (v.short_circuit_current_A - v.max_power_current_A) / v.max_power_voltage_V;
  const double conductance = fall / (1 - fall * rs);
  return {v.short_circuit_current_A * (1 + conductance * rs), rs, 1 / conductance};
}

std::vector<double> KneeCurrents(const DataSheetValues& v) {
  std::vector<double> current_A;
  for (std::size_t k = 0; k <= kVoltages; ++k) {
    const double voltage = v.open_circuit_voltage_V * static_cast<double>(k) / kVoltages;
    const double isc = v.short_circuit_current_A, imp = v.max_power_current_A;
    current_A.push_back(voltage < v.max_power_voltage_V
                            ? isc - (isc - imp) * voltage / v.max_power_voltage_V
                            : imp * (v.open_circuit_voltage_V - voltage) /
                                  (v.open_circuit_voltage_V - v.max_power_voltage_V));
  }
  return current_A;
}

std::vector<double> SharedOf(const SheetSolver& solver, const DataSheetMember& member) {
  return SharedOf(solver.translation, DeviceOf(member), solver.sheet.values.alpha_sc_A_K,
                  solver.points.gap);
}

std::vector<double> CurrentsOf(const SheetSolver& solver, const DataSheetMember& member) {
  const TranslatedDevice at = TranslateTo(solver.translation, SharedOf(solver, member),
                                          kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  std::vector<double> current_A;
  for (std::size_t k = 0; k <= kVoltages; ++k) {
    const double voltage =
        solver.sheet.values.open_circuit_voltage_V * static_cast<double>(k) / kVoltages;
    current_A.push_back(SolveOperatingPoint(at.device, at.parameters.data(), voltage).current_A);
  }
  return current_A;
}

MemberSpread SpreadOf(const SheetSolver& solver, const std::vector<DataSheetMember>& members,
                      const std::vector<std::vector<double>>& curves_A) {
  const DataSheetValues& v = solver.sheet.values;
  MemberSpread spread;
  for (std::size_t k = 0; k <= kVoltages; ++k) {
    double low = kInfinity, high = -kInfinity;
    for (const std::vector<double>& curve : curves_A) {
      low = std::min(low, curve[k]);
      high = std::max(high, curve[k]);
    }
    if (high - low <= spread.difference_A) continue;
    spread.difference_A = high - low;
    spread.at_V = v.open_circuit_voltage_V * static_cast<double>(k) / kVoltages;
  }
  spread.difference_percent = 100 * spread.difference_A / v.short_circuit_current_A;
  spread.lowest_power_W = spread.highest_power_W = members.front().max_power_W;
  for (const DataSheetMember& member : members) {
    for (std::size_t k = 0; k < member.max_power_W.size(); ++k) {
      spread.lowest_power_W[k] = std::min(spread.lowest_power_W[k], member.max_power_W[k]);
      spread.highest_power_W[k] = std::max(spread.highest_power_W[k], member.max_power_W[k]);
    }
  }
  return spread;
}

// A device with the coefficients and powers that De Soto's law predicts from its parameters.
DataSheetMember MemberOf(const SheetSolver& solver, const ReferenceDevice& device) {
  DataSheetMember member;
  member.n = device.n;
  member.photocurrent_A = device.photocurrent_A;
  member.saturation_current_A = device.saturation_current_A;
  member.resistance_series_ohm = device.resistance_series_ohm;
  member.resistance_shunt_ohm = 1 / device.shunt_conductance_S;
  const std::vector<double> shared = SharedOf(solver, member);
  const auto points = [&](double irradiance_W_m2, double temperature_K) {
    const TranslatedDevice at =
        TranslateTo(solver.translation, shared, irradiance_W_m2, temperature_K);
    return ModelKeyPoints(at.device, at.parameters.data());
  };
  const auto voc = [&](double step_K) {
    return points(kReferenceIrradiance_W_m2, kReferenceTemperature_K + step_K)
        .open_circuit_voltage_V;
  };
  member.beta_oc_V_K = (voc(kVocStep_K) - voc(0)) / kVocStep_K;
  member.gamma_pmp_percent_K =
      CoefficientsAtReference(solver.translation, shared).gamma_pmp_percent_K;
  for (const MemberConditions& at : kConditions) {
    const double above_K = at.temperature_C - kReferenceTemperature_C;
    member.max_power_W.push_back(
        points(at.irradiance_W_m2, kReferenceTemperature_K + above_K).max_power_W);
  }
  return member;
}

DataSheetMember MemberOf(const SheetSolver& solver, const KeyPointCurve& curve) {
  return MemberOf(solver, ToDevice(solver.points, curve));
}

// The member for n, or the last member if n is beyond it.
DataSheetMember MemberAt(const SheetSolver& solver, const DataSheetFamily& family, double n) {
  if (n >= family.members.back().n) return family.members.back();
  const auto curve = PhysicalCurve(solver.points, n);
  return curve ? MemberOf(solver, *curve) : family.members.front();
}

Expected<SheetSolver> MakeSolver(const DataSheet& sheet, ConstantSet constants) {
  TranslationSpec spec;
  spec.cells_in_series = sheet.cells_in_series;
  spec.constants = constants;
  TRY(Translation translation, MakeTranslation(spec));
  const double thermal_V =
      sheet.cells_in_series * ThermalVoltage(kReferenceTemperature_K, constants);
  return SheetSolver{
      sheet, std::move(translation), {sheet.values, thermal_V, constants, GapOf(sheet)}};
}

double LowestIdeality(const KeyPointSheet& sheet) {
  return sheet.values.open_circuit_voltage_V / (sheet.thermal_V * kLargestSheetExponent);
}

Expected<KeyPointCurve> FindLast(const SheetSolver& solver, FamilyBound* bound) {
  const double lowest = LowestIdeality(solver.points);
  const double highest = lowest * kLargestSheetExponent / kSmallestExponent;
  double inside = lowest;
  if (!PhysicalCurve(solver.points, inside)) {
    return Fail(fmt::format(
        "no single diode in {} cells has a curve through these points: n would have to be below "
        "{:.2g}; is the knee as sharp as that, and the number of cells right?",
        solver.sheet.cells_in_series, lowest));
  }
  while (inside < highest && PhysicalCurve(solver.points, inside * kExponentStep)) {
    inside *= kExponentStep;
  }
  return LastCurve(solver.points, inside, inside * kExponentStep, bound);
}

}  // namespace

ReferenceDevice DeviceOf(const DataSheetMember& member) {
  return {member.photocurrent_A, member.saturation_current_A, member.n,
          member.resistance_series_ohm, 1 / member.resistance_shunt_ohm};
}

Expected<DataSheetFamily> FindDataSheetFamily(const DataSheet& sheet, ConstantSet constants) {
  TRY(CheckDataSheetForFamily(sheet));
  TRY(const SheetSolver solver, MakeSolver(sheet, constants));
  DataSheetFamily family;
  TRY(const KeyPointCurve last, FindLast(solver, &family.bound));
  family.sharp_knee = KneeOf(sheet.values);
  family.conditions.assign(std::begin(kConditions), std::end(kConditions));
  const double first = std::max(last.n / kMembers, LowestIdeality(solver.points));
  std::vector<std::vector<double>> curves_A = {KneeCurrents(sheet.values)};
  for (int k = 0; k < kMembers; ++k) {
    const bool at_end = k + 1 == kMembers;
    const double n = first + (last.n - first) * k / (kMembers - 1);
    const auto curve = at_end ? std::optional(last) : PhysicalCurve(solver.points, n);
    if (!curve) continue;
    family.members.push_back(MemberOf(solver, *curve));
    curves_A.push_back(CurrentsOf(solver, family.members.back()));
  }
  family.spread = SpreadOf(solver, family.members, curves_A);
  return family;
}

Expected<DataSheetMember> FindDataSheetMember(const DataSheet& sheet, double n,
                                              ConstantSet constants) {
  TRY(CheckDataSheetForFamily(sheet));
  TRY(const SheetSolver solver, MakeSolver(sheet, constants));
  FamilyBound bound;
  TRY(const KeyPointCurve last, FindLast(solver, &bound));
  if (n == last.n) return MemberOf(solver, last);
  const double lowest = LowestIdeality(solver.points);
  const auto curve = n >= lowest && n < last.n ? PhysicalCurve(solver.points, n) : std::nullopt;
  if (!curve) {
    return Fail(
        fmt::format("no single diode with n = {} has a curve through these points: n has "
                    "to be from {:.3g} to {:.6g}",
                    n, lowest, last.n));
  }
  return MemberOf(solver, *curve);
}

Expected<DataSheetFamily> FamilyOfSheet(const DataSheet& sheet, ConstantSet constants,
                                        const ReferenceDevice& device, double lowest_n,
                                        double highest_n) {
  TRY(DataSheetFamily family, FindDataSheetFamily(sheet, constants));
  TRY(const SheetSolver solver, MakeSolver(sheet, constants));
  DataSheetMember picked = MemberOf(solver, device);
  const std::vector<double> own_A = CurrentsOf(solver, picked);
  const auto compare = [&](DataSheetMember* member) {
    std::vector<double> current_A = CurrentsOf(solver, *member);
    member->difference_A = 0;
    for (std::size_t k = 0; k < own_A.size(); ++k) {
      member->difference_A = std::max(member->difference_A, std::fabs(current_A[k] - own_A[k]));
    }
    return current_A;
  };
  compare(&picked);
  for (DataSheetMember& member : family.members) compare(&member);
  family.picked = picked;
  if (!(lowest_n < highest_n)) return family;
  DataSheetMember low = MemberAt(solver, family, lowest_n);
  DataSheetMember high = MemberAt(solver, family, highest_n);
  const std::vector<std::vector<double>> curves_A = {compare(&low), own_A, compare(&high)};
  family.rounding_spread = SpreadOf(solver, {low, picked, high}, curves_A);
  family.rounding_low = std::move(low);
  family.rounding_high = std::move(high);
  return family;
}

}  // namespace lyrefit
