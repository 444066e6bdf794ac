#include "lyrefit/family/family_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/technology.h"
#include "lyrefit/model/default_values.h"
#include "lyrefit/model/pvlib_parameters.h"

namespace lyrefit {
namespace {

constexpr double kSameTemperature_K = 5;  // too small a range to fit temperature coefficients
constexpr double kSameIrradiance = 1.5;   // ratio; a smaller one does not determine the shunt law

struct ValueRange {
  double low = HUGE_VAL;
  double high = 0;
  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Ranges over the fitted curves.
struct Spreads {
  ValueRange irradiance;
  ValueRange temperature;
};

using Reasons = std::map<int, std::string>;  // parameter index -> reason why it is fixed

Spreads SpreadsOf(const FamilyMembers& curves) {
  Spreads spreads;
  for (const int c : curves.fitted) {
    const JointCurve& curve = curves.members[c].joint;
    if (std::isfinite(curve.irradiance_sd)) spreads.irradiance.Add(curve.irradiance_W_m2);
    if (std::isfinite(curve.temperature_sd_K)) spreads.temperature.Add(curve.temperature_K);
  }
  return spreads;
}

// Largest voltage of the fitted curve with the largest Isc.
double OpenCircuitVoltage(const FamilyMembers& curves) {
  double voltage = 0;
  double current = 0;
  for (const int c : curves.fitted) {
    const FamilyMember& member = curves.members[c];
    if (member.short_circuit_current_A <= current) continue;
    current = member.short_circuit_current_A;
    voltage = *std::max_element(member.joint.voltage_V.begin(), member.joint.voltage_V.end());
  }
  return voltage;
}

// `junctions`: in series in each cell, whose idealities add.
void SetRanges(int junctions, FamilyProblem* family) {
  const Translation& at = family->translation;
  const auto range = [&](int i, double lower, double upper, double from, double to,
                         SearchScale scale = SearchScale::kLinear) {
    if (i >= 0) family->bounds[i] = {lower, upper, from, to, scale};
  };
  family->bounds.resize(at.size() + 2);
  const double current = family->curves.reference_current_A;
  const double voltage = OpenCircuitVoltage(family->curves);
  const double resistance = voltage / current;
  const double thermal = at.device.module_thermal_voltage_V;
  const auto saturation = [&](double n) { return current * std::exp(-voltage / (n * thermal)); };
  range(at.photocurrent, 0.2 * current, 5 * current, 0.7 * current, 1.4 * current);
  range(at.saturation_current, 0, kInfinity, 0.1 * saturation(junctions),
        10 * saturation(1.8 * junctions), SearchScale::kLog);
  range(at.n, 0.5, 4.0 * junctions, junctions, 1.8 * junctions);
  range(at.resistance_series, 0, 0.5 * resistance, 0, 0.15 * resistance);
  range(at.resistance_shunt, 0.05 * resistance, kInfinity, resistance, 1000 * resistance,
        SearchScale::kLog);
  range(at.alpha_sc, -0.02 * current, 0.02 * current, -5e-4 * current, 1.5e-3 * current);
  range(at.adjust, -1000, 1000, -30, 30);
  range(at.bandgap, 0.3, 2.5 * junctions, 0.9, 1.5);
  range(at.bandgap_slope, -0.01, 0.01, -5e-4, 0);
  range(at.n_slope, -0.05, 0.05, -3e-3, 3e-3);
  range(at.resistance_shunt_dark, 0, kInfinity, resistance, 4000 * resistance, SearchScale::kLog);
  range(at.shunt_exponent, 0.1, 30, 1, 10);
  range(at.saturation_current_2, 0, kInfinity, 1e-3 * saturation(2), 3 * saturation(2),
        SearchScale::kLog);
  range(at.n_2, 1, 4, 1.5, 3);
  const double built_in = kDefaultBuiltIn_V * at.spec.cells_in_series;
  range(at.recombination, 0, built_in, 0, 0.05 * built_in);
  range(at.built_in_voltage, voltage * 1.05, 3 * built_in, built_in, 1.2 * built_in);
  range(at.size(), 0, 0, 0, 0);
  range(at.size() + 1, 0, 0, 0, 0);
}

void FixAt(int i, double value, FamilyProblem* family) {
  if (i >= 0) family->fixed[i] = value;
}

// Fixes the parameters that are fitted only on request.
void FixDefaults(FamilyProblem* family) {
  const Translation& at = family->translation;
  const double built_in = kDefaultBuiltIn_V * at.spec.cells_in_series;
  family->fixed.assign(at.size() + 2, kUnknown);
  FixAt(at.bandgap_slope, kDefaultBandgapSlope_per_K, family);
  FixAt(at.shunt_exponent, kDefaultShuntExponent, family);
  FixAt(at.n_2, kDefaultIdeality2, family);
  FixAt(at.built_in_voltage, std::max(built_in, OpenCircuitVoltage(family->curves) * 1.05), family);
  FixAt(at.size(), 0, family);
  FixAt(at.size() + 1, 0, family);
}

// The stated gap, or that of a stated thin film, or silicon's.
double StatedBandgap(const CurveSet& set) {
  for (const IvCurve& curve : set.curves) {
    if (curve.notes.bandgap_eV) return *curve.notes.bandgap_eV;
  }
  const std::string& technology = set.curves.front().notes.technology;
  const Technology* known = FindTechnology(technology);
  return known != nullptr && !known->silicon ? known->pvsyst_bandgap_eV() : kDefaultBandgap_eV;
}

double StatedTempco_A(const CurveSet& set, double reference_current_A) {
  double tempco_A = kDefaultTempco_per_K * reference_current_A;
  for (const IvCurve& curve : set.curves) {
    const DeviceNotes& notes = curve.notes;
    if (notes.isc_tempco_A_per_K) tempco_A = *notes.isc_tempco_A_per_K;
    if (notes.isc_tempco_per_K) tempco_A = *notes.isc_tempco_per_K * reference_current_A;
  }
  return tempco_A;
}

// Temperature coefficient of Isc at 1000 W/m2 from the curves' own Isc, by least squares over their
// temperatures; or as stated.
double MeasuredTempco_A(const CurveSet& set, const FamilyMembers& curves) {
  for (const IvCurve& curve : set.curves) {
    if (curve.notes.isc_tempco_A_per_K || curve.notes.isc_tempco_per_K) {
      return StatedTempco_A(set, curves.reference_current_A);
    }
  }
  double count = 0, dt = 0, isc = 0, dt_dt = 0, dt_isc = 0;
  for (const int c : curves.fitted) {
    const FamilyMember& member = curves.members[c];
    if (member.IsDark()) continue;
    const double x = member.joint.temperature_K - kReferenceTemperature_K;
    const double y =
        member.short_circuit_current_A * kReferenceIrradiance_W_m2 / member.joint.irradiance_W_m2;
    count += 1;
    dt += x;
    isc += y;
    dt_dt += x * x;
    dt_isc += x * y;
  }
  return (count * dt_isc - dt * isc) / (count * dt_dt - dt * dt);
}

Reasons FixUnidentifiable(const CurveSet& set, const FamilyOptions& options,
                          const ValueRange& temperature, FamilyProblem* family) {
  Reasons reasons;
  const auto fix = [&](int i, double value, const std::string& why) {
    FixAt(i, value, family);
    if (i >= 0) reasons[i] = why;
  };
  const Translation& at = family->translation;
  const bool pvsyst = at.spec.law == TranslationLaw::kPvsyst;
  const bool cec = at.spec.law == TranslationLaw::kCec;
  if (pvsyst) FixAt(at.bandgap, StatedBandgap(set), family);
  if (cec) FixAt(at.bandgap, kPvlibBandgap_eV, family);  // a CEC row states none
  if (cec) FixAt(at.alpha_sc, MeasuredTempco_A(set, family->curves), family);
  if (!(temperature.high - temperature.low >= kSameTemperature_K)) {
    const std::string why =
        fmt::format("the temperatures differ by less than {:g} K", kSameTemperature_K);
    fix(at.alpha_sc, StatedTempco_A(set, family->curves.reference_current_A), why);
    if (!pvsyst && !cec) fix(at.bandgap, StatedBandgap(set), why);
    fix(at.adjust, 0, why);
    fix(at.n_slope, 0, why);
  } else if (options.temperature_offset && !pvsyst && !cec) {
    fix(at.bandgap, StatedBandgap(set),
        "a common error of the temperature sensor looks like another band gap");
  }
  return reasons;
}

Expected<int> Position(const Translation& at, const std::string& name, const char* flag) {
  const auto found = at.Find(name);
  if (found) return *found;
  std::string names;
  for (const ParameterInfo& info : at.parameters) {
    names += (names.empty() ? "" : ", ") + info.name;
  }
  return Fail(
      fmt::format("{}: no parameter {} in this law: expected one of {}", flag, name, names));
}

Expected<void> Bound(const std::string& name, const std::pair<double, double>& range,
                     FamilyProblem* family) {
  TRY(const int i, Position(family->translation, name, "bound"));
  const ParameterKind kind = family->translation.parameters[i].kind;
  if (kind == ParameterKind::kSaturation || kind == ParameterKind::kDarkShunt) {
    return Fail(
        fmt::format("bound: {} has no bounds of its own in a family fit: bound n or "
                    "R_sh_ref, or fix it",
                    name));
  }
  if (!(range.first < range.second)) {
    return Fail(fmt::format("bound: {} = {:g}:{:g} is empty: expected lower:upper", name,
                            range.first, range.second));
  }
  ParameterBounds& bounds = family->bounds[i];
  bounds.lower = range.first;
  bounds.upper = range.second;
  bounds.search_lower = std::max(bounds.search_lower, bounds.lower);
  bounds.search_upper = std::min(bounds.search_upper, bounds.upper);
  if (bounds.search_lower >= bounds.search_upper) {
    bounds.search_lower = bounds.lower;
    bounds.search_upper = std::isfinite(bounds.upper) ? bounds.upper : 10 * bounds.lower;
  }
  return {};
}

// Applies the user's fixed values and bounds. Parameters that the user sets need no note, so their
// reasons are erased.
Expected<void> ApplyWishes(const FamilyOptions& options, FamilyProblem* family, Reasons* reasons) {
  const Translation& at = family->translation;
  for (const std::string& name : options.freed) {
    TRY(const int i, Position(at, name, "free"));
    family->fixed[i] = kUnknown;
    reasons->erase(i);
  }
  for (const auto& [name, value] : options.fixed) {
    TRY(const int i, Position(at, name, "fix"));
    const ParameterBounds& range = family->bounds[i];
    if (!(value >= range.lower && value <= range.upper)) {
      return Fail(fmt::format("fix: {} = {:g} is outside [{:g}, {:g}]", name, value, range.lower,
                              range.upper));
    }
    family->fixed[i] = value;
    reasons->erase(i);
  }
  for (const auto& [name, range] : options.bounds) TRY(Bound(name, range, family));
  return {};
}

Expected<void> FreeSensorErrors(const FamilyOptions& options, const Spreads& spreads,
                                FamilyProblem* family) {
  const int offsets = family->translation.size();
  if (options.irradiance_offset) {
    const ValueRange& irradiance = spreads.irradiance;
    if (!(irradiance.high >= kSameIrradiance * irradiance.low)) {
      return Fail(
          "irradiance-offset: curves under one irradiance cannot tell a sensor's error from the "
          "photocurrent: expected irradiances that differ by a factor of 1.5 or more");
    }
    const double most = 0.9 * irradiance.low;
    family->bounds[offsets] = {-std::min(most, 300.0), 300, -0.3 * most, 0.3 * most,
                               SearchScale::kLinear};
    family->fixed[offsets] = kUnknown;
  }
  if (options.temperature_offset) {
    const ValueRange& temperature = spreads.temperature;
    if (!(temperature.high - temperature.low >= kSameTemperature_K)) {
      return Fail(
          "temperature-offset: curves at one temperature cannot tell a sensor's error from n and "
          "the saturation current: expected temperatures that differ by 5 K or more");
    }
    family->bounds[offsets + 1] = {-40, 40, -10, 10, SearchScale::kLinear};
    family->fixed[offsets + 1] = kUnknown;
  }
  return {};
}

// Sets bounds, fixed values and their reasons.
Expected<void> Bind(const CurveSet& set, const FamilyOptions& options, FamilyProblem* family) {
  const Spreads spreads = SpreadsOf(family->curves);
  SetRanges(JunctionsPerCell(set.curves.front().notes.technology), family);
  FixDefaults(family);
  Reasons reasons = FixUnidentifiable(set, options, spreads.temperature, family);
  TRY(ApplyWishes(options, family, &reasons));
  TRY(FreeSensorErrors(options, spreads, family));
  for (const auto& [i, why] : reasons) {
    family->notes.push_back(fmt::format("{} is fixed at {:.6g}: {}",
                                        family->translation.parameters[i].name, family->fixed[i],
                                        why));
  }
  for (const double value : family->fixed) family->free_parameters += std::isnan(value);
  return {};
}

Expected<void> CheckOptions(const FamilyOptions& options) {
  TRY(ValidateOptions(options.search, kSearchOptionTable));
  TRY(ValidateThreads(options.threads));
  const auto in_range = [](double value, double lower, double upper) {
    return value >= lower && value <= upper;
  };
  if (!in_range(options.irradiance_accuracy, 0, 0.5)) {
    return Fail(fmt::format("irradiance-accuracy = {:g} % is outside [0, 50]",
                            100 * options.irradiance_accuracy));
  }
  if (!in_range(options.temperature_accuracy_K, 0, 50)) {
    return Fail(fmt::format("temperature-accuracy = {:g} K is outside [0, 50]",
                            options.temperature_accuracy_K));
  }
  if (options.search_curves < 1) return Fail("search-curves: expected at least 1");
  if (options.fit_curves != 0 && options.fit_curves < 2) {
    return Fail("fit-curves: expected at least 2, or 0 for all");
  }
  if (options.folds < 0 || options.folds == 1) {
    return Fail("folds: expected at least 2, or 0 for none");
  }
  return {};
}

}  // namespace

Expected<FamilyProblem> MakeFamilyProblem(const CurveSet& set, const FamilyOptions& options) {
  TRY(CheckOptions(options));
  FamilyProblem family;
  TRY(family.curves, MakeFamilyMembers(set, options));
  family.notes = family.curves.notes;
  TranslationSpec spec;
  spec.law = options.law;
  spec.model = options.model;
  const bool pvsyst = options.law == TranslationLaw::kPvsyst;
  spec.shunt = options.shunt.value_or(pvsyst ? ShuntLaw::kExponential : ShuntLaw::kInverse);
  spec.recombination = options.recombination;
  spec.cells_in_series = set.curves[family.curves.fitted[0]].conditions.cells_in_series;
  spec.constants = options.constants;
  TRY(family.translation, MakeTranslation(spec));
  TRY(Bind(set, options, &family));
  if (!options.with.empty()) TRY(AddFamilyEffects(set, options, &family));
  return family;
}

JointProblem JointProblemOn(const FamilyProblem& family, const FamilyOptions& options,
                            const std::vector<int>& curves) {
  JointProblem problem;
  problem.translation = family.translation;
  problem.objective = options.objective;
  for (const int c : curves) problem.curves.push_back(family.curves.members[c].joint);
  problem.key_point_scale_A =
      options.key_point_errors.max_power * family.curves.reference_current_A;
  for (std::size_t i = 0; i < family.bounds.size(); ++i) {
    const bool fixed = !std::isnan(family.fixed[i]);
    problem.lower.push_back(fixed ? family.fixed[i] : family.bounds[i].lower);
    problem.upper.push_back(fixed ? family.fixed[i] : family.bounds[i].upper);
  }
  FindJointScales(&problem);
  return problem;
}

}  // namespace lyrefit
