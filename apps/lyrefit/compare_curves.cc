#include <fmt/format.h>

#include <algorithm>

#include "compare_flags.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/nearest_curve.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

// One pair of irradiance and temperature.
struct StudyCondition {
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
};

Expected<StudyCondition> ParseStudyCondition(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const std::optional<double> irradiance = ParseNumber(text.substr(0, cross));
    const std::optional<double> temperature = ParseNumber(text.substr(cross + 1));
    if (irradiance && temperature) return StudyCondition{*irradiance, *temperature};
  }
  return Fail(fmt::format("--at: expected irradiance and temperature such as 1000x25, found {}",
                          Quoted(text)));
}

// "1000x25,200x25", given to --at.
Expected<std::vector<StudyCondition>> ParseStudyConditions(const std::string& text) {
  TRY(const auto parts, ParseList("--at", text));
  std::vector<StudyCondition> conditions;
  for (const std::string& part : parts) {
    TRY(const auto condition, ParseStudyCondition(part));
    conditions.push_back(condition);
  }
  return conditions;
}

// Adds a curve of the set to `chosen`, once.
Expected<void> Choose(const CurveSet& set, std::size_t curve, const std::string& flag,
                      std::vector<std::size_t>* chosen) {
  if (std::find(chosen->begin(), chosen->end(), curve) != chosen->end()) {
    return Fail(fmt::format("{}: that is {} once more", flag, LabelInSet(set, set.curves[curve])),
                set.source);
  }
  chosen->push_back(curve);
  return {};
}

// Indices of the curves selected by the flags, in the order of the flags.
Expected<std::vector<std::size_t>> ChosenCurves(const CurveSet& set, const CompareFlags& flags) {
  std::vector<std::size_t> chosen;
  if (!flags.curve_ids.empty()) {
    TRY(const auto ids, ParseList("--curves", flags.curve_ids));
    for (const std::string& id : ids) {
      TRY(const auto found, FindCurve(set, id));
      TRY(Choose(set, found, "--curves " + id, &chosen));
    }
  }
  if (flags.at.empty()) return chosen;
  TRY(const auto conditions, ParseStudyConditions(flags.at));
  for (const StudyCondition& at : conditions) {
    TRY(const auto found, NearestCurve(set, at.irradiance_W_m2, at.temperature_C));
    const std::string flag = fmt::format("--at {:g}x{:g}", at.irradiance_W_m2, at.temperature_C);
    TRY(Choose(set, found, flag, &chosen));
  }
  return chosen;
}

Expected<void> Add(IvCurve curve, const std::string& file, const CompareFlags& flags,
                   std::vector<CompareCurve>* curves) {
  TRY(BoundsSpec bounds, FlaggedBounds(flags.bounds, file));
  for (const auto& [name, range] : flags.ranges) bounds.overrides[name] = range;
  curves->push_back(MakeSubject(std::move(curve), std::move(bounds)));
  return {};
}

Expected<void> AddFromSet(const std::string& file, const CompareFlags& flags,
                          std::vector<CompareCurve>* curves) {
  TRY(const auto set, ReadCurveSet(file));
  TRY(const auto chosen, ChosenCurves(set, flags));
  for (const std::size_t i : chosen) {
    IvCurve curve = set.curves[i];
    TRY(ApplyConditionFlags(flags.conditions, &curve));
    curve.name = LabelInSet(set, curve);
    TRY(Add(std::move(curve), file, flags, curves));
  }
  return {};
}

Expected<void> AddCurve(const std::string& file, const CompareFlags& flags,
                        std::vector<CompareCurve>* curves) {
  Expected<IvCurve> curve = ReadCurve(file, {});
  if (!curve && HoldsCurveSet(file)) {
    return Fail("holds a set of curves: choose some with --at 1000x25,200x25 or --curves ID,ID",
                file);
  }
  if (!curve) return tl::unexpected(curve.error());
  TRY(ApplyConditionFlags(flags.conditions, &*curve));
  return Add(std::move(*curve), file, flags, curves);
}

}  // namespace

Expected<std::vector<std::string>> ParseList(const std::string& flag, const std::string& text) {
  const auto parts = SplitList(text);
  if (!parts) return Fail(flag + ": " + parts.error().message);
  return *parts;
}

Expected<std::vector<CompareCurve>> ReadComparedCurves(const CompareFlags& flags) {
  const bool choosing = !flags.at.empty() || !flags.curve_ids.empty();
  std::vector<CompareCurve> curves;
  for (const std::string& file : flags.curve_files) {
    // Curves selected from a file that is not a set: the set's reader gives the error.
    TRY(choosing ? AddFromSet(file, flags, &curves) : AddCurve(file, flags, &curves));
  }
  return curves;
}

}  // namespace lyrefit
