#include "lyrefit/study/compare_journal.h"

#include <fmt/format.h>

#include "lyrefit/base/version.h"

namespace lyrefit {
namespace {

std::string CurveText(const IvCurve& curve) {
  const Conditions& at = curve.conditions;
  std::vector<double> all = {at.cell_temperature_K, at.irradiance_W_m2,
                             static_cast<double>(at.cells_in_series),
                             static_cast<double>(at.strings_in_parallel)};
  for (const auto* column : {&curve.voltage_V, &curve.current_A, &curve.sigma_A}) {
    all.insert(all.end(), column->begin(), column->end());
  }
  return fmt::format("{} points, {:g} C, {:g} W/m2, {} cells ({})", curve.size(),
                     at.cell_temperature_K - kZeroCelsius_K, at.irradiance_W_m2, at.cells_in_series,
                     Fingerprint(all));
}

std::string BoundsText(const CompareCurve& subject, const CompareOptions& options) {
  std::vector<double> all;
  for (const Model model : options.models) {
    const Device device = MakeDevice(model, subject.curve.conditions, options.constants);
    const auto bounds = MakeBounds(subject.bounds, device, subject.curve);
    if (!bounds) continue;
    for (const ParameterBounds& b : *bounds) {
      all.insert(all.end(), {b.lower, b.upper, b.search_lower, b.search_upper,
                             b.scale == SearchScale::kLog ? 1.0 : 0.0});
    }
  }
  return fmt::format("{} ({})", subject.bounds.name, Fingerprint(all));
}

std::string SettingsText(const Contender& contender) {
  std::vector<OptionEcho> echoes;
  AppendNonDefaults(contender.search, kSearchOptionTable, &echoes);
  std::string text =
      contender.searcher ? "a search of its own" : ToText(contender.search.algorithm);
  for (const OptionEcho& echo : echoes) {
    if (echo.name != "seed" && echo.name != "run") text += ", " + echo.name + " " + echo.value;
  }
  return text;
}

}  // namespace

JournalLine CompareHead(const std::vector<CompareCurve>& curves,
                        const std::vector<Contender>& contenders, const CompareOptions& options) {
  JournalLine head = {{"lyrefit", Version()},
                      {"seed", options.seed},
                      {"objective", ToText(options.objective)},
                      {"constants", ToText(options.constants)},
                      {"polish", options.polish},
                      {"plain-polish", options.plain_polish}};
  std::string models, names, effects;
  for (const EffectUse& use : options.with)
    effects += (effects.empty() ? "" : " ") + DescribeUse(use);
  if (!effects.empty()) head["with"] = effects;
  for (const Model model : options.models) models += (models.empty() ? "" : ",") + ToText(model);
  for (const Contender& c : contenders) names += (names.empty() ? "" : ",") + c.name;
  head["models"] = models;
  head["algorithms"] = names;
  for (const Contender& c : contenders) head["algorithm " + c.name] = SettingsText(c);
  head["number of curves"] = curves.size();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string which = fmt::format("{} {}", i + 1, curves[i].curve.name);
    head["curve " + which] = CurveText(curves[i].curve);
    head["bounds of curve " + which] = BoundsText(curves[i], options);
  }
  return head;
}

JournalLine WriteRun(const RunPlace& place, const ProblemResult& problem,
                     const Contender& contender, const CompareOptions& options,
                     const RunOutcome& outcome) {
  const RunRecord& record = outcome.record;
  JournalLine gains = JournalLine::array();
  for (const TracePoint& point : outcome.gains) {
    gains.push_back({point.iteration, point.evaluations, ExactNumber(point.best)});
  }
  return {{"problem", place.problem},
          {"curve", problem.curve_name},
          {"model", ToText(problem.model)},
          {"contender", place.contender},
          {"algorithm", contender.name},
          {"run", place.run},
          {"seed", options.seed},
          {"searched_A", ExactNumber(record.searched_A)},
          {"plain_polished_A", ExactNumber(record.plain_polished_A)},
          {"best_bird_polished_A", ExactNumber(record.own_polished_A)},
          {"refined_A", ExactNumber(record.polished_A)},
          {"evaluations", record.evaluations},
          {"search_seconds", ExactNumber(record.search_seconds)},
          {"refine_seconds", ExactNumber(record.polish_seconds)},
          {"parameters", ExactNumbers(outcome.parameters)},
          {"trace", std::move(gains)}};
}

Expected<WrittenRun> ReadRun(const Journal& journal, const Journal::Record& record) {
  RecordReader read(journal, record);
  WrittenRun run;
  run.place.problem = static_cast<int>(read.Whole("problem"));
  run.place.contender = static_cast<int>(read.Whole("contender"));
  run.place.run = static_cast<int>(read.Whole("run"));
  RunRecord& r = run.outcome.record;
  r.run = run.place.run;
  r.searched_A = read.Number("searched_A");
  r.plain_polished_A = read.Number("plain_polished_A");
  r.own_polished_A = read.Number("best_bird_polished_A");
  r.polished_A = read.Number("refined_A");
  r.evaluations = read.Whole("evaluations");
  r.search_seconds = read.Number("search_seconds");
  r.polish_seconds = read.Number("refine_seconds");
  run.outcome.parameters = read.Numbers("parameters");
  bool sound = true;
  for (const std::vector<double>& row : read.Rows("trace")) {
    sound = sound && row.size() == 3;
    if (!sound) break;
    run.outcome.gains.push_back(
        {static_cast<std::int64_t>(row[0]), static_cast<std::int64_t>(row[1]), row[2]});
  }
  if (auto checked = read.Checked(); !checked) return tl::unexpected(checked.error());
  if (!sound || run.outcome.gains.empty()) {
    return Fail("expected rows of three numbers as trace of this record", journal.path(),
                record.line);
  }
  return run;
}

}  // namespace lyrefit
