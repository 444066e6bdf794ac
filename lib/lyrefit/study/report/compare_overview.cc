#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/report/compare_sections.h"

namespace lyrefit {
namespace {

constexpr int kOverviewDigits = 4;  // what fits a terminal; the tables of each curve have more

constexpr std::size_t kLongContender = 18;  // no room beside it for the largest polished figure

bool ManyCurves(const Comparison& comparison) {
  const auto& problems = comparison.problems;
  return std::any_of(problems.begin(), problems.end(), [&](const ProblemResult& problem) {
    return problem.curve_name != problems.front().curve_name;
  });
}

bool LongNames(const ProblemResult& problem) {
  return std::any_of(problem.contenders.begin(), problem.contenders.end(),
                     [](const auto& contender) { return contender.name.size() >= kLongContender; });
}

std::vector<std::string> OverviewRow(const ContenderResult& contender, bool polish, bool brief) {
  const Spread& s = contender.searched;
  std::vector<std::string> row = {"  " + contender.name,
                                  Scientific(s.min, kOverviewDigits),
                                  Scientific(s.mean, kOverviewDigits),
                                  Scientific(s.median, kOverviewDigits),
                                  Scientific(s.max, kOverviewDigits),
                                  Scientific(s.std, 2)};
  if (polish) {
    const Spread& p = contender.polished;
    row.push_back(Scientific(p.min, kOverviewDigits));
    if (!brief) row.push_back(Scientific(p.max, kOverviewDigits));
    row.push_back(std::to_string(p.within_1e9));
  }
  return row;
}

}  // namespace

std::string OverviewSection(const Comparison& comparison) {
  if (!ManyCurves(comparison)) return "";
  const bool polish = comparison.options.polish;
  std::string text = fmt::format("\nAll curves: RMSE in A ({}) of {} runs of the search alone{}\n",
                                 ToText(comparison.options.objective), comparison.options.runs,
                                 polish ? ", and polished" : "");
  // One table, so that the columns of all curves stand below each other; the curves' own lines,
  // which are longer than a cell, go between its rows.
  TextTable table("lrrrrrrrr");
  std::vector<std::string> head = {"  algorithm", "min", "mean", "median", "max", "std"};
  const bool brief = LongNames(comparison.problems.front());
  if (polish) head.emplace_back("polished");
  if (polish && !brief) head.emplace_back("to max");
  if (polish) head.emplace_back("1e-9");
  table.Add(head);
  std::vector<std::string> titles = {""};
  for (const ProblemResult& problem : comparison.problems) {
    for (std::size_t c = 0; c < problem.contenders.size(); ++c) {
      titles.push_back(c == 0 ? Wrap("  ", ProblemTitle(problem)) : "");
      table.Add(OverviewRow(problem.contenders[c], polish, brief));
    }
  }
  const std::string rows = table.Text();
  std::size_t begin = 0;
  for (const std::string& title : titles) {
    const std::size_t end = rows.find('\n', begin) + 1;
    text += title + rows.substr(begin, end - begin);
    begin = end;
  }
  return text;
}

}  // namespace lyrefit
