#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/nearest_curve.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/read_curve.h"
#include "study_flags.h"

namespace lyrefit {
namespace {

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

// Takes a curve of the set once.
Expected<void> Choose(const CurveSet& set, std::size_t curve, const std::string& flag,
                      std::vector<std::size_t>* chosen) {
  if (std::find(chosen->begin(), chosen->end(), curve) != chosen->end()) {
    return Fail(fmt::format("{}: that is {} once more", flag, LabelInSet(set, set.curves[curve])),
                set.source);
  }
  chosen->push_back(curve);
  return {};
}

// Positions of the curves that the flags name, in their order.
Expected<std::vector<std::size_t>> ChosenCurves(const CurveSet& set, const StudyFlags& flags) {
  std::vector<std::size_t> chosen;
  if (!flags.curve_ids.empty()) {
    const auto ids = ParseList("--curves", flags.curve_ids);
    if (!ids) return tl::unexpected(ids.error());
    for (const std::string& id : *ids) {
      const auto found = FindCurve(set, id);
      if (!found) return tl::unexpected(found.error());
      auto taken = Choose(set, *found, "--curves " + id, &chosen);
      if (!taken) return tl::unexpected(taken.error());
    }
  }
  if (flags.at.empty()) return chosen;
  const auto conditions = ParseStudyConditions(flags.at);
  if (!conditions) return tl::unexpected(conditions.error());
  for (const StudyCondition& at : *conditions) {
    const auto found = NearestCurve(set, at.irradiance_W_m2, at.temperature_C);
    if (!found) return tl::unexpected(found.error());
    const std::string flag = fmt::format("--at {:g}x{:g}", at.irradiance_W_m2, at.temperature_C);
    auto taken = Choose(set, *found, flag, &chosen);
    if (!taken) return tl::unexpected(taken.error());
  }
  return chosen;
}

Expected<void> Add(IvCurve curve, const std::string& file, const StudyFlags& flags,
                   std::vector<CompareCurve>* curves) {
  TRY(BoundsSpec bounds, NamedBounds(flags.bounds, file));
  for (const auto& [name, range] : flags.ranges) bounds.overrides[name] = range;
  curves->push_back(MakeSubject(std::move(curve), std::move(bounds)));
  return {};
}

Expected<void> AddFromSet(const std::string& file, const StudyFlags& flags,
                          std::vector<CompareCurve>* curves) {
  const Expected<CurveSet> set = ReadCurveSet(file);
  if (!set) return tl::unexpected(set.error());
  const auto chosen = ChosenCurves(*set, flags);
  if (!chosen) return tl::unexpected(chosen.error());
  for (const std::size_t i : *chosen) {
    IvCurve curve = set->curves[i];
    if (auto applied = ApplyConditionFlags(flags.conditions, &curve); !applied) return applied;
    curve.name = LabelInSet(*set, curve);
    if (auto added = Add(std::move(curve), file, flags, curves); !added) return added;
  }
  return {};
}

Expected<void> AddCurve(const std::string& file, const StudyFlags& flags,
                        std::vector<CompareCurve>* curves) {
  Expected<IvCurve> curve = ReadCurve(file, {});
  if (!curve && HoldsCurveSet(file)) {
    return Fail("holds a set of curves: choose some with --at 1000x25,200x25 or --curves ID,ID",
                file);
  }
  if (!curve) return tl::unexpected(curve.error());
  if (auto applied = ApplyConditionFlags(flags.conditions, &*curve); !applied) return applied;
  return Add(std::move(*curve), file, flags, curves);
}

}  // namespace

Expected<std::vector<StudyCondition>> ParseStudyConditions(const std::string& text) {
  const auto parts = ParseList("--at", text);
  if (!parts) return tl::unexpected(parts.error());
  std::vector<StudyCondition> conditions;
  for (const std::string& part : *parts) {
    const auto condition = ParseStudyCondition(part);
    if (!condition) return tl::unexpected(condition.error());
    conditions.push_back(*condition);
  }
  return conditions;
}

Expected<std::vector<CompareCurve>> ReadStudyCurves(const StudyFlags& flags) {
  if (!flags.landscape.empty()) return LandscapeSubjects(flags);
  const bool choosing = !flags.at.empty() || !flags.curve_ids.empty();
  std::vector<CompareCurve> curves;
  for (const std::string& file : flags.curve_files) {
    // A file that does not look like a set, with curves asked of it: the set's reader says why not.
    auto added = choosing ? AddFromSet(file, flags, &curves) : AddCurve(file, flags, &curves);
    if (!added) return tl::unexpected(added.error());
  }
  return curves;
}

}  // namespace lyrefit
