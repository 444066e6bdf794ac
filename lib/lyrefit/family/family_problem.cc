#include "lyrefit/family/family_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/base/parallel.h"
#include "lyrefit/family/family_effects.h"
#include "lyrefit/law/held_values.h"

namespace lyrefit {
namespace {

constexpr double kSameTemperature_K = 5;  // a smaller spread says nothing about coefficients
constexpr double kSameIrradiance = 1.5;   // ratio; a smaller one says nothing about the shunt

struct Spread {
  double low = HUGE_VAL;
  double high = 0;
  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

class Builder {
 public:
  Builder(const CurveSet& set, const FamilyOptions& options, FamilyProblem* family)
      : set_(set), options_(options), f_(*family), at_(family->translation) {}

  Expected<void> Build() {
    for (const int c : f_.curves.fitted) {
      const JointCurve& curve = f_.curves.members[c].joint;
      if (std::isfinite(curve.irradiance_sd)) irradiance_.Add(curve.irradiance_W_m2);
      if (std::isfinite(curve.temperature_sd_K)) temperature_.Add(curve.temperature_K);
    }
    SetRanges();
    HoldWhatCannotBeSeen();
    if (auto checked = ApplyWishes(); !checked) return checked;
    if (auto checked = SensorErrors(); !checked) return checked;
    TellWhatIsHeld();
    for (const double value : f_.fixed) f_.free_parameters += std::isnan(value);
    return {};
  }

 private:
  void Range(int i, double lower, double upper, double from, double to,
             SearchScale scale = SearchScale::kLinear) {
    if (i >= 0) f_.bounds[i] = {lower, upper, from, to, scale};
  }

  void HoldAt(int i, double value, const std::string& why) {
    if (i < 0) return;
    f_.fixed[i] = value;
    if (!why.empty()) reasons_[i] = why;
  }

  // Of what is held without having been asked for.
  void TellWhatIsHeld() {
    for (const auto& [i, why] : reasons_) {
      f_.notes.push_back(
          fmt::format("{} is held at {:.6g}: {}", at_.parameters[i].name, f_.fixed[i], why));
    }
  }

  // Of the curve nearest to the reference.
  double OpenCircuitVoltage() const {
    double voltage = 0;
    double current = 0;
    for (const int c : f_.curves.fitted) {
      const FamilyMember& member = f_.curves.members[c];
      if (member.short_circuit_current_A <= current) continue;
      current = member.short_circuit_current_A;
      voltage = *std::max_element(member.joint.voltage_V.begin(), member.joint.voltage_V.end());
    }
    return voltage;
  }

  void SetRanges() {
    f_.bounds.resize(at_.size() + 2);
    f_.fixed.assign(at_.size() + 2, kUnknown);
    const double current = f_.curves.reference_current_A;
    const double voltage = OpenCircuitVoltage();
    const double resistance = voltage / current;
    const double thermal = at_.device.module_thermal_voltage_V;
    const auto saturation = [&](double n) { return current * std::exp(-voltage / (n * thermal)); };
    Range(at_.photocurrent, 0.2 * current, 5 * current, 0.7 * current, 1.4 * current);
    Range(at_.saturation_current, 0, kInfinity, 0.1 * saturation(1), 10 * saturation(1.8),
          SearchScale::kLog);
    Range(at_.n, 0.5, 4, 1, 1.8);
    Range(at_.resistance_series, 0, 0.5 * resistance, 0, 0.15 * resistance);
    Range(at_.resistance_shunt, 0.05 * resistance, kInfinity, resistance, 1000 * resistance,
          SearchScale::kLog);
    Range(at_.alpha_sc, -0.02 * current, 0.02 * current, -5e-4 * current, 1.5e-3 * current);
    Range(at_.bandgap, 0.3, 2.5, 0.9, 1.5);
    Range(at_.bandgap_slope, -0.01, 0.01, -5e-4, 0);
    Range(at_.n_slope, -0.05, 0.05, -3e-3, 3e-3);
    Range(at_.resistance_shunt_dark, 0, kInfinity, resistance, 4000 * resistance,
          SearchScale::kLog);
    Range(at_.shunt_exponent, 0.1, 30, 1, 10);
    Range(at_.saturation_current_2, 0, kInfinity, 1e-3 * saturation(2), 3 * saturation(2),
          SearchScale::kLog);
    Range(at_.n_2, 1, 4, 1.5, 3);
    const double built_in = kHeldBuiltIn_V * at_.spec.cells_in_series;
    Range(at_.recombination, 0, built_in, 0, 0.05 * built_in);
    Range(at_.built_in_voltage, voltage * 1.05, 3 * built_in, built_in, 1.2 * built_in);
    Range(at_.size(), 0, 0, 0, 0);
    Range(at_.size() + 1, 0, 0, 0, 0);
    HoldAt(at_.bandgap_slope, kHeldBandgapSlope_per_K, "");
    HoldAt(at_.shunt_exponent, kHeldShuntExponent, "");
    HoldAt(at_.n_2, kHeldIdeality2, "");
    HoldAt(at_.built_in_voltage, std::max(built_in, voltage * 1.05), "");
    f_.fixed[at_.size()] = f_.fixed[at_.size() + 1] = 0;
  }

  double StatedBandgap() const {
    for (const IvCurve& curve : set_.curves) {
      if (curve.notes.bandgap_eV) return *curve.notes.bandgap_eV;
    }
    return kHeldBandgap_eV;
  }

  void HoldWhatCannotBeSeen() {
    const bool pvsyst = at_.spec.law == TranslationLaw::kPvsyst;
    if (pvsyst) HoldAt(at_.bandgap, StatedBandgap(), "");
    if (!(temperature_.high - temperature_.low >= kSameTemperature_K)) {
      double tempco_A = kHeldTempco_per_K * f_.curves.reference_current_A;
      for (const IvCurve& curve : set_.curves) {
        const DeviceNotes& notes = curve.notes;
        if (notes.isc_tempco_A_per_K) tempco_A = *notes.isc_tempco_A_per_K;
        if (notes.isc_tempco_per_K) {
          tempco_A = *notes.isc_tempco_per_K * f_.curves.reference_current_A;
        }
      }
      const std::string why =
          fmt::format("the temperatures differ by less than {:g} K", kSameTemperature_K);
      HoldAt(at_.alpha_sc, tempco_A, why);
      if (!pvsyst) HoldAt(at_.bandgap, StatedBandgap(), why);
      HoldAt(at_.n_slope, 0, why);
    } else if (options_.temperature_offset && !pvsyst) {
      HoldAt(at_.bandgap, StatedBandgap(),
             "a common error of the temperature sensor looks like another band gap");
    }
  }

  Expected<int> Position(const std::string& name, const char* flag) const {
    const auto found = at_.Find(name);
    if (found) return *found;
    std::string names;
    for (const ParameterInfo& info : at_.parameters) {
      names += (names.empty() ? "" : ", ") + info.name;
    }
    return Fail(
        fmt::format("{}: no parameter {} in this law: expected one of {}", flag, name, names));
  }

  Expected<void> ApplyWishes() {
    for (const std::string& name : options_.freed) {
      const auto i = Position(name, "free");
      if (!i) return tl::unexpected(i.error());
      f_.fixed[*i] = kUnknown;
      reasons_.erase(*i);
    }
    for (const auto& [name, value] : options_.fixed) {
      const auto i = Position(name, "fix");
      if (!i) return tl::unexpected(i.error());
      const ParameterBounds& range = f_.bounds[*i];
      if (!(value >= range.lower && value <= range.upper)) {
        return Fail(fmt::format("fix: {} = {:g} is outside [{:g}, {:g}]", name, value, range.lower,
                                range.upper));
      }
      f_.fixed[*i] = value;
      reasons_.erase(*i);
    }
    for (const auto& [name, range] : options_.bounds) {
      const auto i = Position(name, "bound");
      if (!i) return tl::unexpected(i.error());
      const ParameterKind kind = at_.parameters[*i].kind;
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
      ParameterBounds& bounds = f_.bounds[*i];
      bounds.lower = range.first;
      bounds.upper = range.second;
      bounds.search_lower = std::max(bounds.search_lower, bounds.lower);
      bounds.search_upper = std::min(bounds.search_upper, bounds.upper);
      if (bounds.search_lower >= bounds.search_upper) {
        bounds.search_lower = bounds.lower;
        bounds.search_upper = std::isfinite(bounds.upper) ? bounds.upper : 10 * bounds.lower;
      }
    }
    return {};
  }

  Expected<void> SensorErrors() {
    if (options_.irradiance_offset) {
      if (!(irradiance_.high >= kSameIrradiance * irradiance_.low)) {
        return Fail(
            "irradiance-offset: curves under one irradiance cannot tell a sensor's error from the "
            "photocurrent: expected irradiances that differ by a factor of 1.5 or more");
      }
      const double most = 0.9 * irradiance_.low;
      Range(at_.size(), -std::min(most, 300.0), 300, -0.3 * most, 0.3 * most);
      f_.fixed[at_.size()] = kUnknown;
    }
    if (options_.temperature_offset) {
      if (!(temperature_.high - temperature_.low >= kSameTemperature_K)) {
        return Fail(
            "temperature-offset: curves at one temperature cannot tell a sensor's error from n and "
            "the saturation current: expected temperatures that differ by 5 K or more");
      }
      Range(at_.size() + 1, -40, 40, -10, 10);
      f_.fixed[at_.size() + 1] = kUnknown;
    }
    return {};
  }

  const CurveSet& set_;
  const FamilyOptions& options_;
  FamilyProblem& f_;
  const Translation& at_;
  std::map<int, std::string> reasons_;  // why a parameter is held
  Spread irradiance_;
  Spread temperature_;
};

Expected<void> CheckOptions(const FamilyOptions& options) {
  if (auto valid = ValidateOptions(options.search, kSearchOptionTable); !valid) return valid;
  if (auto valid = ValidateThreads(options.threads); !valid) return valid;
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
  if (auto checked = CheckOptions(options); !checked) return tl::unexpected(checked.error());
  Expected<FamilyMembers> members = MakeFamilyMembers(set, options);
  if (!members) return tl::unexpected(members.error());
  FamilyProblem family;
  family.curves = std::move(*members);
  family.notes = family.curves.notes;
  TranslationSpec spec;
  spec.law = options.law;
  spec.model = options.model;
  const bool pvsyst = options.law == TranslationLaw::kPvsyst;
  spec.shunt = options.shunt.value_or(pvsyst ? ShuntLaw::kExponential : ShuntLaw::kInverse);
  spec.recombination = options.recombination;
  spec.cells_in_series = set.curves[family.curves.fitted[0]].conditions.cells_in_series;
  spec.constants = options.constants;
  Expected<Translation> translation = MakeTranslation(spec);
  if (!translation) return tl::unexpected(translation.error());
  family.translation = std::move(*translation);
  if (auto built = Builder(set, options, &family).Build(); !built) {
    return tl::unexpected(built.error());
  }
  if (!options.with.empty()) {
    auto added = AddFamilyEffects(set, options, &family);
    if (!added) return tl::unexpected(added.error());
  }
  return family;
}

JointProblem JointProblemOn(const FamilyProblem& family, const FamilyOptions& options,
                            const std::vector<int>& curves) {
  JointProblem problem;
  problem.translation = family.translation;
  problem.objective = options.objective;
  for (const int c : curves) problem.curves.push_back(family.curves.members[c].joint);
  for (std::size_t i = 0; i < family.bounds.size(); ++i) {
    const bool fixed = !std::isnan(family.fixed[i]);
    problem.lower.push_back(fixed ? family.fixed[i] : family.bounds[i].lower);
    problem.upper.push_back(fixed ? family.fixed[i] : family.bounds[i].upper);
  }
  FindJointScales(&problem);
  return problem;
}

}  // namespace lyrefit
