#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/documents.h"

namespace lyrefit {
namespace {

std::vector<double> ValuesOf(const ProblemResult& problem, double SearchOptions::*setting) {
  std::vector<double> values;
  for (const AlgorithmResult& compared : problem.algorithms) {
    values.push_back(compared.search.*setting);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

using CellText = std::function<std::string(const AlgorithmResult&)>;

// A table with Pm in rows and gamma in columns.
block::Table Grid(const ProblemResult& problem, std::string caption, const CellText& cell) {
  using Rate = ColumnOf<double>;
  std::vector<Rate> columns = {{"", [](double rate) { return fmt::format("Pm = {:g}", rate); }}};
  for (const double gamma : ValuesOf(problem, &SearchOptions::distance_coefficient)) {
    columns.push_back({fmt::format("gamma = {:g}", gamma), [&, gamma](double rate) {
                         for (const AlgorithmResult& c : problem.algorithms) {
                           const bool is = c.search.memory_rate == rate &&
                                           c.search.distance_coefficient == gamma;
                           if (is) return cell(c);
                         }
                         return std::string("-");
                       }});
  }
  return TableOf(ValuesOf(problem, &SearchOptions::memory_rate), columns, std::move(caption));
}

// A sentence on the cell with the lowest mean, and on the hits after the polish.
std::string RateVerdict(const ProblemResult& problem) {
  const auto best = std::min_element(
      problem.algorithms.begin(), problem.algorithms.end(),
      [](const auto& a, const auto& b) { return a.searched.mean < b.searched.mean; });
  std::string text =
      fmt::format("The lowest mean of the search alone is {} A at Pm = {:g}, gamma = {:g}.",
                  Scientific(best->searched.mean, 6), best->search.memory_rate,
                  best->search.distance_coefficient);
  if (std::isnan(best->polished.min)) return text;
  std::size_t hits = 0, runs = 0;
  for (const AlgorithmResult& compared : problem.algorithms) {
    hits += compared.polished.within_1e9;
    runs += compared.runs.size();
  }
  return text +
         fmt::format(" After the polish {} of {} runs of all settings end within 1e-9 of {} A.",
                     hits, runs, Scientific(problem.reference.rmse_A, 10));
}

std::vector<Section> SensitivitySections(const Comparison& comparison,
                                         const ProblemResult& problem) {
  const std::string objective = ToText(comparison.options.objective);
  const std::string runs = RunsText(comparison, problem);
  Section section = ProblemSection(comparison, problem);
  const auto add = [&](const char* what, double RunSpread::*field, int digits) {
    AddTable(Grid(problem, fmt::format("Search alone: {} ({}) of {} runs", what, objective, runs),
                  [field, digits](const AlgorithmResult& c) {
                    return Scientific(c.searched.*field, digits);
                  }),
             &section);
  };
  add("smallest RMSE in A", &RunSpread::min, 6);
  add("mean RMSE in A", &RunSpread::mean, 6);
  add("standard deviation of the RMSE in A", &RunSpread::std, 4);
  if (comparison.options.polish) {
    AddTable(
        Grid(problem,
             fmt::format("Polished (all starts): runs of {} within 1e-9 ({})", runs, objective),
             [](const AlgorithmResult& c) { return std::to_string(c.polished.within_1e9); }),
        &section);
  }
  return {std::move(section), {"", {block::Sentence{RateVerdict(problem)}}, 1}};
}

}  // namespace

Document SensitivityDocument(const Comparison& comparison) {
  Document document = {CompareBanners(comparison)};
  Section& head = document.head;
  head.heading =
      fmt::format("lyrefit {}: sensitivity of MLO to Pm and gamma, {} of each setting on {}",
                  comparison.version, Plural(comparison.options.runs, "run"),
                  Plural(comparison.problems.size(), "problem"));
  AddSetUp(comparison, &head);
  AddField("paper",
           "J. Ind. Manag. Optim. 22(1), 642-690: its Table 17 is captioned minimum and holds "
           "means; Table 18 holds standard deviations. Pm = 0 with gamma = 0 is LO.",
           &head);
  AddField("time", Duration(comparison.seconds), &head);
  for (const ProblemResult& problem : comparison.problems) {
    AddSections(SensitivitySections(comparison, problem), &document);
  }
  return document;
}

std::string SensitivityText(const Comparison& comparison) {
  return DrawText(SensitivityDocument(comparison));
}

}  // namespace lyrefit
