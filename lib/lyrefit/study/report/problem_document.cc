#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/study/problem_ranks.h"
#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/problem_verdict.h"

namespace lyrefit {
namespace {

constexpr std::size_t kColumns = 6;  // number of budgets side by side

std::string InPercent(double share) {
  return std::isnan(share) ? "-" : Significant(100 * share, 3);
}

// All budgets in increasing order; 0 comes first if there are algorithms without a budget.
std::vector<std::int64_t> BudgetsOf(const ProblemSummary& summary) {
  std::set<std::int64_t> budgets;
  for (const AlgorithmSummary& compared : summary.algorithms) budgets.insert(compared.budget);
  return {budgets.begin(), budgets.end()};
}

std::vector<std::string> AlgorithmsOf(const ProblemSummary& summary) {
  std::vector<std::string> names;
  for (const AlgorithmSummary& compared : summary.algorithms) {
    if (std::find(names.begin(), names.end(), compared.algorithm) == names.end()) {
      names.push_back(compared.algorithm);
    }
  }
  return names;
}

const LevelSummary* Cell(const ProblemSummary& summary, const std::string& algorithm,
                         std::int64_t budget, PolishLevel level) {
  for (const AlgorithmSummary& compared : summary.algorithms) {
    if (compared.algorithm != algorithm || compared.budget != budget) continue;
    if (compared.At(level)) return &*compared.At(level);
  }
  return nullptr;
}

ColumnOf<std::string> NameOfAlgorithm() {
  return {"algorithm", [](const std::string& name) { return name; }};
}

// Hits and median time of a run for some budgets.
block::Table HitTable(const ProblemSummary& summary, PolishLevel level,
                      const std::vector<std::int64_t>& budgets) {
  std::vector<std::string> algorithms = AlgorithmsOf(summary);
  const auto has_none = [&](const std::string& algorithm) {
    return std::none_of(budgets.begin(), budgets.end(), [&](std::int64_t budget) {
      return Cell(summary, algorithm, budget, level) != nullptr;
    });
  };
  algorithms.erase(std::remove_if(algorithms.begin(), algorithms.end(), has_none),
                   algorithms.end());
  std::vector<ColumnOf<std::string>> columns = {NameOfAlgorithm()};
  for (const std::int64_t budget : budgets) {
    columns.push_back({budget == 0 ? "as it is" : std::to_string(budget),
                       [&, budget](const std::string& algorithm) {
                         const LevelSummary* cell = Cell(summary, algorithm, budget, level);
                         return cell ? fmt::format("{} ({})", cell->hits, Duration(cell->seconds))
                                     : "";
                       }});
  }
  return TableOf(algorithms, columns);
}

// Adds the hit tables of a level under one caption; nothing if no run has this level.
void AddHits(const ProblemSummary& summary, PolishLevel level, Section* section) {
  int runs = 0;
  for (const AlgorithmSummary& compared : summary.algorithms) {
    if (compared.At(level)) runs = std::max(runs, compared.At(level)->runs);
  }
  if (runs == 0) return;
  const std::vector<std::int64_t> budgets = BudgetsOf(summary);
  for (std::size_t begin = 0; begin < budgets.size(); begin += kColumns) {
    const auto from = budgets.begin() + static_cast<std::ptrdiff_t>(begin);
    const std::size_t count = std::min(kColumns, budgets.size() - begin);
    block::Table table =
        HitTable(summary, level, {from, from + static_cast<std::ptrdiff_t>(count)});
    if (begin == 0) {
      table.caption = fmt::format("{}: hits of {}, median time of a run ({})", ToText(level),
                                  Plural(runs, "run"), ToText(summary.devices[0]->objective));
    }
    AddTable(std::move(table), section);
  }
}

// True for the largest budget of each algorithm.
bool IsLargest(const ProblemSummary& summary, const AlgorithmSummary& compared) {
  return std::none_of(
      summary.algorithms.begin(), summary.algorithms.end(), [&](const AlgorithmSummary& other) {
        return other.algorithm == compared.algorithm && other.budget > compared.budget;
      });
}

void AddFailures(const ProblemSummary& summary, Section* section) {
  block::Table table = {
      "llrrrrrrrr",
      {{"algorithm", "level", "missed", "optima", "most", "% above", "median", "worst", "% wrong",
        "worst"}},
      {},
      "Cost of failure, largest budgets: runs that missed, the wrong local optima they ended in, "
      "runs in the commonest and how far its RMSE is above the best known one (%); median and "
      "worst "
      "of that over all that missed; and median and worst of how far their most deviating "
      "parameter "
      "is from its value there (%)"};
  for (const AlgorithmSummary& compared : summary.algorithms) {
    if (!IsLargest(summary, compared)) continue;
    for (const PolishLevel level : {PolishLevel::kOwn, PolishLevel::kHybrid}) {
      if (!compared.At(level) || compared.At(level)->failures.runs == 0) continue;
      const Failures& failures = compared.At(level)->failures;
      table.rows.push_back({compared.name, ToText(level), std::to_string(failures.runs),
                            std::to_string(failures.local_optima),
                            std::to_string(failures.commonest),
                            InPercent(failures.commonest_excess), InPercent(failures.median_excess),
                            InPercent(failures.worst_excess), InPercent(failures.median_deviation),
                            InPercent(failures.worst_deviation)});
    }
  }
  if (!table.rows.empty()) AddTable(std::move(table), section);
}

std::string EffectsOfProblem(const ProblemSummary& summary) {
  std::string text;
  for (const EffectUse& use : summary.devices[0]->with) text += ", with " + DescribeUse(use);
  return text;
}

std::string ReferenceText(const ProblemSummary& summary) {
  if (summary.devices.size() == 1) return summary.devices[0]->reference.origin;
  int multistart = 0;
  std::int64_t points = 0, visits = 0;
  for (const ProblemResult* device : summary.devices) {
    multistart += device->reference.by_multistart;
    points += device->reference.points;
    visits += device->reference.visits;
  }
  std::string text =
      fmt::format("of each device its best known optimum, {} certified", summary.certified);
  if (points == 0) return text;
  return text +
         fmt::format(
             "; {} that only a multistart found, of whose {} random points {} % end in the "
             "best known optimum of their device",
             multistart, points,
             Significant(100 * static_cast<double>(visits) / static_cast<double>(points), 3));
}

Section ProblemSection(const ProblemSummary& summary) {
  const ProblemResult& first = *summary.devices[0];
  Section section = {fmt::format("{}, {} model{}, {}{}", summary.name, ModelTitle(first.model),
                                 first.family ? " of a family" : "",
                                 Plural(summary.devices.size(), "device"),
                                 EffectsOfProblem(summary))};
  AddField("objective", ToText(first.objective), &section);
  if (first.family) {
    AddField("search", "sees some of the curves; its figures are of its best candidate on all",
             &section);
  }
  AddField("reference", ReferenceText(summary), &section);
  for (const PolishLevel level : kPolishLevels) AddHits(summary, level, &section);
  AddFailures(summary, &section);
  return section;
}

// "1.83"; "-" if there is no ranking.
std::string MeanRank(const Ranking& ranking, std::size_t c) {
  return ranking.friedman.algorithms == 0 ? "-"
                                          : fmt::format("{:.2f}", ranking.friedman.mean_rank[c]);
}

std::string FriedmanP(const Ranking& ranking) {
  return ranking.friedman.algorithms == 0 ? "-" : fmt::format("{:.1g}", ranking.friedman.p_value);
}

// Mean ranks, one column for each budget.
block::Table RankTable(const std::vector<SummaryRanking>& rankings) {
  block::Table::Row last = {"p"};
  std::vector<std::string> names;
  std::vector<ColumnOf<std::string>> columns = {NameOfAlgorithm()};
  for (const SummaryRanking& ranking : rankings) {
    last.push_back(FriedmanP(ranking.searched) + " / " + FriedmanP(ranking.own));
    for (const std::string& name : ranking.names) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    columns.push_back({std::to_string(ranking.budget), [&ranking](const std::string& name) {
                         const auto at =
                             std::find(ranking.names.begin(), ranking.names.end(), name);
                         if (at == ranking.names.end()) return std::string();
                         const auto c = static_cast<std::size_t>(at - ranking.names.begin());
                         return MeanRank(ranking.searched, c) + " / " + MeanRank(ranking.own, c);
                       }});
  }
  block::Table table = TableOf(names, columns);
  table.rows.push_back(std::move(last));
  return table;
}

// Adds the significantly better algorithms, by the best candidate's polish and by the search alone.
void AddPairs(const SummaryRanking& ranking, Section* section) {
  for (const bool own : {false, true}) {
    std::vector<std::string> winners =
        WinnerSentences(ranking.names, own ? ranking.own : ranking.searched);
    const std::string title = fmt::format("{} evaluations, {}:{}", ranking.budget,
                                          own ? "best candidate's polish" : "search alone",
                                          winners.empty() ? " no pair is told apart" : "");
    section->blocks.push_back(block::Entry{title, std::move(winners)});
  }
}

// The rankings first .. last of one problem, or of all problems together.
Section RankingSection(const SummaryRanking* first, const SummaryRanking* last, bool with_pairs) {
  Section section = {fmt::format("{}, {} blocks",
                                 first->problem.empty() ? "All problems" : first->problem,
                                 first->searched.friedman.blocks)};
  for (const SummaryRanking* begin = first; begin < last;) {
    const SummaryRanking* end = begin + std::min<std::ptrdiff_t>(kColumns, last - begin);
    AddTable(RankTable({begin, end}), &section);
    begin = end;
  }
  for (; with_pairs && first != last; ++first) AddPairs(*first, &section);
  return section;
}

std::vector<Section> RankingSections(const std::vector<ProblemSummary>& summaries) {
  const std::vector<SummaryRanking> rankings = RankProblems(summaries);
  if (rankings.empty()) return {};
  std::vector<Section> sections = {
      {"",
       {block::Legend{
           "Mean ranks of RMSE / reference, search alone / best candidate's polish, and p of "
           "Friedman's test; blocks are device and run, figures within 1e-6 of each "
           "other equal; pairs by Wilcoxon's test, Holm-corrected"}}}};
  const SummaryRanking* const end = rankings.data() + rankings.size();
  for (const SummaryRanking* first = rankings.data(); first != end;) {
    const SummaryRanking* const next = std::find_if(
        first, end, [&](const SummaryRanking& other) { return other.problem != first->problem; });
    sections.push_back(
        RankingSection(first, next, first->problem.empty() || summaries.size() == 1));
    first = next;
  }
  return sections;
}

// The default fit against the searches of others, one sentence for each problem.
Section PeerSection(const std::vector<ProblemSummary>& summaries) {
  Section section;
  for (const ProblemSummary& summary : summaries) {
    const std::string peer = PeerText(summary);
    if (peer.empty()) continue;
    if (section.blocks.empty()) {
      section.blocks.push_back(block::Legend{
          fmt::format("The default fit against the best peer of equal success: by pagmo2, with the "
                      "best candidate's "
                      "own polish, run as often as it takes to hit with a probability of {} %",
                      100 * kEnoughShare)});
    }
    AddSentence(summary.name + ": " + peer + ".", &section);
  }
  return section;
}

}  // namespace

std::vector<Section> ProblemSections(const Comparison& comparison) {
  const std::vector<ProblemSummary> summaries = SummariseProblems(comparison);
  if (summaries.empty()) return {};
  Section which = {"Which search, from which budget, or none"};
  for (const ProblemSummary& summary : summaries) AddSentence(VerdictText(summary) + ".", &which);
  std::vector<Section> sections = {
      {"",
       {block::Legend{"Hits and median time of a run: of starts from the curve's shape alone, of "
                      "the default fit, of the fastest search that is enough or else of the one "
                      "with the most hits, of random points likewise, and of the peer that is sure "
                      "to hit the soonest"},
        VerdictTable(summaries)}},
      std::move(which),
      PeerSection(summaries)};
  for (const ProblemSummary& summary : summaries) sections.push_back(ProblemSection(summary));
  for (Section& section : RankingSections(summaries)) sections.push_back(std::move(section));
  return sections;
}

}  // namespace lyrefit
