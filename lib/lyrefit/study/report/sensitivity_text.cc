#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/study/report/compare_sections.h"
#include "lyrefit/study/report/compare_text.h"

namespace lyrefit {
namespace {

std::vector<double> ValuesOf(const ProblemResult& problem, double SearchOptions::*setting) {
  std::vector<double> values;
  for (const ContenderResult& contender : problem.contenders) {
    values.push_back(contender.search.*setting);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

using CellText = std::function<std::string(const ContenderResult&)>;

// Pm downwards, gamma to the right.
std::string Grid(const ProblemResult& problem, const CellText& cell) {
  const std::vector<double> rates = ValuesOf(problem, &SearchOptions::memory_rate);
  const std::vector<double> coefficients = ValuesOf(problem, &SearchOptions::distance_coefficient);
  TextTable table("l" + std::string(coefficients.size(), 'r'));
  std::vector<std::string> head = {""};
  for (const double gamma : coefficients) head.push_back(fmt::format("gamma = {:g}", gamma));
  table.Add(head);
  for (const double rate : rates) {
    std::vector<std::string> line = {fmt::format("Pm = {:g}", rate)};
    for (const double gamma : coefficients) {
      const auto found = std::find_if(
          problem.contenders.begin(), problem.contenders.end(), [&](const ContenderResult& c) {
            return c.search.memory_rate == rate && c.search.distance_coefficient == gamma;
          });
      line.push_back(found == problem.contenders.end() ? "-" : cell(*found));
    }
    table.Add(line);
  }
  return table.Text();
}

// The cell with the lowest mean, and how little the polish cares.
std::string RateVerdict(const ProblemResult& problem) {
  const auto best = std::min_element(
      problem.contenders.begin(), problem.contenders.end(),
      [](const auto& a, const auto& b) { return a.searched.mean < b.searched.mean; });
  std::string text = fmt::format(
      "The lowest mean of the search alone is {} A at Pm = {:g}, "
      "gamma = {:g}.",
      Scientific(best->searched.mean, 6), best->search.memory_rate,
      best->search.distance_coefficient);
  if (std::isnan(best->polished.min)) return text;
  std::size_t hits = 0, runs = 0;
  for (const ContenderResult& contender : problem.contenders) {
    hits += contender.polished.within_1e9;
    runs += contender.runs.size();
  }
  return text + fmt::format(
                    " After the polish {} of {} runs of all settings end within 1e-9 of {} "
                    "A.",
                    hits, runs, Scientific(problem.reference.rmse_A, 10));
}

std::string SensitivityOf(const Comparison& comparison, const ProblemResult& problem) {
  const std::string objective = ToText(comparison.options.objective);
  const std::string runs = RunsText(comparison, problem);
  const auto figure = [](double Spread::*field, int digits) {
    return
        [field, digits](const ContenderResult& c) { return Scientific(c.searched.*field, digits); };
  };
  std::string text = "\n" + ProblemTitle(problem) + "\n" + ReferenceField(comparison, problem);
  text += fmt::format("\n  Search alone: smallest RMSE in A ({}) of {} runs\n", objective, runs);
  text += Grid(problem, figure(&Spread::min, 6));
  text += fmt::format("\n  Search alone: mean RMSE in A ({}) of {} runs\n", objective, runs);
  text += Grid(problem, figure(&Spread::mean, 6));
  text += fmt::format("\n  Search alone: standard deviation of the RMSE in A ({}) of {} runs\n",
                      objective, runs);
  text += Grid(problem, figure(&Spread::std, 4));
  if (comparison.options.polish) {
    text +=
        fmt::format("\n  Polished (all starts): runs of {} within 1e-9 ({})\n", runs, objective);
    text += Grid(problem,
                 [](const ContenderResult& c) { return std::to_string(c.polished.within_1e9); });
  }
  return text + "\n" + Wrap("  ", RateVerdict(problem));
}

}  // namespace

std::string SensitivityText(const Comparison& comparison) {
  std::string text = InterruptedLine(comparison);
  text += fmt::format("lyrefit {}: sensitivity of MLO to Pm and gamma, {} of each setting on {}\n",
                      comparison.version, Plural(comparison.options.runs, "run"),
                      Plural(comparison.problems.size(), "problem"));
  text += SetUpSection(comparison);
  text += Field("paper",
                "J. Ind. Manag. Optim. 22(1), 642-690: its Table 17 is captioned minimum and holds "
                "means; Table 18 holds standard deviations. Pm = 0 with gamma = 0 is LO.");
  text += Field("time", Duration(comparison.seconds));
  for (const ProblemResult& problem : comparison.problems)
    text += SensitivityOf(comparison, problem);
  return text;
}

}  // namespace lyrefit
