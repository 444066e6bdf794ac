#include "lyrefit/study/compare_journal.h"

#include <fmt/format.h>

#include "lyrefit/base/version.h"
#include "lyrefit/family/family_documents.h"

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

std::string SetText(const CurveSet& set) {
  std::string all = fmt::format("{} curves", set.curves.size());
  for (const IvCurve& curve : set.curves) all += "; " + CurveText(curve);
  return all;
}

std::string FamilyText(const FamilyOptions& options) {
  std::string text;
  for (const OptionEcho& echo : NonDefaults(options, kFamilyOptionTable)) {
    text += (text.empty() ? "" : ", ") + echo.name + " " + echo.value;
  }
  return text;
}

// Adds the settings of a curve that override those of the comparison.
void AddOwn(const CompareCurve& subject, const std::string& which, JournalLine* head) {
  JournalLine& lines = *head;
  if (!subject.problem.empty()) lines["problem of curve " + which] = subject.problem;
  if (subject.model) lines["model of curve " + which] = ToText(*subject.model);
  if (subject.objective) lines["objective of curve " + which] = ToText(*subject.objective);
  std::string effects;
  for (const EffectUse& use : subject.with) {
    effects += (effects.empty() ? "" : " ") + DescribeUse(use);
  }
  if (!effects.empty()) lines["effects of curve " + which] = effects;
  if (subject.set) lines["family of curve " + which] = FamilyText(subject.family);
}

std::string BoundsText(const CompareCurve& subject, const CompareOptions& options) {
  std::vector<double> all;
  std::vector<Model> models = options.models;
  if (subject.model) models = {*subject.model};
  for (const Model model : models) {
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

std::string SettingsText(const ComparedAlgorithm& compared) {
  std::vector<OptionEcho> echoes;
  AppendNonDefaults(compared.search, kSearchOptionTable, &echoes);
  std::string text = compared.searcher ? "a search of its own" : ToText(compared.search.algorithm);
  if (!compared.searcher_version.empty()) text += " (" + compared.searcher_version + ")";
  if (compared.kind != AlgorithmKind::kSearch) text = ToText(compared.kind) + ": " + text;
  for (const OptionEcho& echo : echoes) {
    if (echo.name != "seed" && echo.name != "run") text += ", " + echo.name + " " + echo.value;
  }
  return text;
}

}  // namespace

JournalLine CompareHead(const std::vector<CompareCurve>& curves,
                        const std::vector<ComparedAlgorithm>& algorithms,
                        const CompareOptions& options) {
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
  if (options.multistart > 0) head["multistart"] = options.multistart;
  for (const Model model : options.models) models += (models.empty() ? "" : ",") + ToText(model);
  for (const ComparedAlgorithm& c : algorithms) names += (names.empty() ? "" : ",") + c.name;
  head["models"] = models;
  head["algorithms"] = names;
  for (const ComparedAlgorithm& c : algorithms) head["algorithm " + c.name] = SettingsText(c);
  head["number of curves"] = curves.size();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const CompareCurve& subject = curves[i];
    const std::string& name = subject.set ? subject.set->name : subject.curve.name;
    const std::string which = fmt::format("{} {}", i + 1, name);
    head["curve " + which] = subject.set ? SetText(*subject.set) : CurveText(subject.curve);
    if (!subject.set) head["bounds of curve " + which] = BoundsText(subject, options);
    AddOwn(subject, which, &head);
  }
  return head;
}

JournalLine WriteRun(const RunPlace& place, const ProblemResult& problem,
                     const ComparedAlgorithm& compared, const CompareOptions& options,
                     const RunOutcome& outcome) {
  const RunRecord& record = outcome.record;
  JournalLine gains = JournalLine::array();
  for (const TracePoint& point : outcome.gains) {
    gains.push_back({point.iteration, point.evaluations, ExactNumber(point.best)});
  }
  JournalLine line = {{"problem", place.problem},
                      {"curve", problem.curve_name},
                      {"model", ToText(problem.model)},
                      {"compared", place.algorithm},
                      {"algorithm", compared.name},
                      {"run", place.run},
                      {"seed", options.seed},
                      {"searched_A", ExactNumber(record.searched_A)},
                      {"plain_polished_A", ExactNumber(record.plain_polished_A)},
                      {"refined_best_candidate_A", ExactNumber(record.own_polished_A)},
                      {"refined_A", ExactNumber(record.polished_A)},
                      {"evaluations", record.evaluations},
                      {"search_seconds", ExactNumber(record.search_seconds)},
                      {"refine_seconds", ExactNumber(record.polish_seconds)},
                      {"parameters", ExactNumbers(outcome.parameters)},
                      {"trace", std::move(gains)}};
  if (record.curve_evaluations != record.evaluations) {
    line["curve_evaluations"] = record.curve_evaluations;
  }
  if (problem.problem.empty()) return line;
  line["plain_seconds"] = ExactNumber(record.plain_seconds);
  line["best_candidate_seconds"] = ExactNumber(record.own_seconds);
  line["best_candidate_parameters"] = ExactNumbers(outcome.own_parameters);
  return line;
}

Expected<WrittenRun> ReadRun(const Journal& journal, const Journal::Record& record) {
  RecordReader read(journal, record);
  WrittenRun run;
  run.place.problem = static_cast<int>(read.Whole("problem"));
  run.place.algorithm = static_cast<int>(read.Whole("compared"));
  run.place.run = static_cast<int>(read.Whole("run"));
  RunRecord& r = run.outcome.record;
  r.run = run.place.run;
  r.searched_A = read.Number("searched_A");
  r.plain_polished_A = read.Number("plain_polished_A");
  r.own_polished_A = read.Number("refined_best_candidate_A");
  r.polished_A = read.Number("refined_A");
  r.evaluations = r.curve_evaluations = read.Whole("evaluations");
  if (record.json.contains("curve_evaluations")) {
    r.curve_evaluations = read.Whole("curve_evaluations");
  }
  r.search_seconds = read.Number("search_seconds");
  r.polish_seconds = read.Number("refine_seconds");
  run.outcome.parameters = read.Numbers("parameters");
  if (record.json.contains("best_candidate_parameters")) {
    r.plain_seconds = read.Number("plain_seconds");
    r.own_seconds = read.Number("best_candidate_seconds");
    run.outcome.own_parameters = read.Numbers("best_candidate_parameters");
  }
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

JournalLine WriteBestKnown(int problem, const BestKnown& known) {
  return {{"problem", problem},         {"best_known_A", ExactNumber(known.best.rmse_A)},
          {"found_by", known.found_by}, {"points", known.points},
          {"visits", known.visits},     {"parameters", ExactNumbers(known.best.parameters)}};
}

bool IsBestKnown(const Journal::Record& record) { return record.json.contains("best_known_A"); }

Expected<WrittenBestKnown> ReadBestKnown(const Journal& journal, const Journal::Record& record) {
  RecordReader read(journal, record);
  WrittenBestKnown written;
  written.problem = static_cast<int>(read.Whole("problem"));
  written.known.best.rmse_A = read.Number("best_known_A");
  written.known.found_by = read.Text("found_by");
  written.known.points = static_cast<int>(read.Whole("points"));
  written.known.visits = static_cast<int>(read.Whole("visits"));
  written.known.best.parameters = read.Numbers("parameters");
  if (auto checked = read.Checked(); !checked) return tl::unexpected(checked.error());
  return written;
}

}  // namespace lyrefit
