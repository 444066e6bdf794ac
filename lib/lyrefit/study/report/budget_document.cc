#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/study/problem_summary.h"
#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/documents.h"

namespace lyrefit {
namespace {

// A level of polish and the distance that counts as a hit.
struct Level {
  const char* title;
  const char* column;
  RunSpread AlgorithmResult::*stage;
  int RunSpread::*hits;
};

constexpr Level kLevels[] = {
    {"Search alone, runs of {} within 1e-6", "search alone", &AlgorithmResult::searched,
     &RunSpread::within_1e6},
    {"One plain solve from the best candidate, runs of {} within 1e-9", "plain solve",
     &AlgorithmResult::plain_polished, &RunSpread::within_1e9},
    {"The best candidate's own polish, runs of {} within 1e-9", "best candidate",
     &AlgorithmResult::own_polished, &RunSpread::within_1e9},
    {"All starts (hybrid), runs of {} within 1e-9", "all starts", &AlgorithmResult::polished,
     &RunSpread::within_1e9},
};

// The results of one algorithm, by increasing budget.
struct SearchRow {
  std::string algorithm;
  std::vector<const AlgorithmResult*> cells;
};

std::vector<SearchRow> RowsOf(const ProblemResult& problem) {
  std::vector<SearchRow> rows;
  for (const AlgorithmResult& compared : problem.algorithms) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const SearchRow& other) {
      return other.algorithm == compared.algorithm;
    });
    if (row == rows.end()) row = rows.insert(rows.end(), {compared.algorithm, {}});
    row->cells.push_back(&compared);
  }
  for (SearchRow& row : rows) {
    std::stable_sort(row.cells.begin(), row.cells.end(), [](const auto* a, const auto* b) {
      return a->search.max_evaluations < b->search.max_evaluations;
    });
  }
  return rows;
}

bool HitsAll(const AlgorithmResult& cell, const Level& level) {
  return (cell.*level.stage).*level.hits == static_cast<int>(cell.runs.size());
}

// The smallest budget from which every run hits at all budgets. Empty: some run misses at the
// largest budget.
std::optional<std::int64_t> EnoughFor(const SearchRow& row, const Level& level) {
  std::optional<std::int64_t> enough;
  for (auto cell = row.cells.rbegin(); cell != row.cells.rend(); ++cell) {
    if (!HitsAll(**cell, level)) break;
    enough = (*cell)->search.max_evaluations;
  }
  return enough;
}

ColumnOf<SearchRow> NamesOfRows() {
  return {"algorithm", [](const SearchRow& row) { return row.algorithm; }};
}

block::Table HitTable(const std::vector<SearchRow>& rows, const Level& level, std::string caption) {
  std::vector<ColumnOf<SearchRow>> columns = {NamesOfRows()};
  for (const AlgorithmResult* head_cell : rows[0].cells) {
    const std::int64_t budget = head_cell->search.max_evaluations;
    columns.push_back({std::to_string(budget), [&level, budget](const SearchRow& row) {
                         for (const AlgorithmResult* cell : row.cells) {
                           if (cell->search.max_evaluations != budget) continue;
                           return std::to_string((cell->*level.stage).*level.hits);
                         }
                         return std::string("-");  // the study was stopped before
                       }});
  }
  return TableOf(rows, columns, std::move(caption));
}

block::Table EnoughTable(const std::vector<SearchRow>& rows, std::string caption) {
  std::vector<ColumnOf<SearchRow>> columns = {NamesOfRows()};
  for (const Level& level : kLevels) {
    columns.push_back({level.column, [&level](const SearchRow& row) {
                         const auto enough = EnoughFor(row, level);
                         return enough ? std::to_string(*enough) : "-";
                       }});
  }
  return TableOf(rows, columns, std::move(caption));
}

// "mlo and de from 1000, lo from 10000; not random"
std::string WhoFromWhere(const std::vector<SearchRow>& rows, const Level& level) {
  std::vector<std::pair<std::int64_t, std::string>> groups;
  std::string never;
  for (const SearchRow& row : rows) {
    const auto enough = EnoughFor(row, level);
    if (!enough) {
      never += (never.empty() ? "" : ", ") + row.algorithm;
      continue;
    }
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& other) { return other.first == *enough; });
    if (group == groups.end()) {
      groups.emplace_back(*enough, row.algorithm);
    } else {
      group->second += ", " + row.algorithm;
    }
  }
  if (groups.empty()) return "no algorithm hits in every run";
  if (groups.size() == 1 && never.empty()) {
    return fmt::format("every algorithm hits in every run from {} evaluations on", groups[0].first);
  }
  std::sort(groups.begin(), groups.end());
  std::string text = "every run hits with ";
  for (std::size_t g = 0; g < groups.size(); ++g) {
    text += fmt::format("{}{} from {} evaluations on", g == 0 ? "" : ", with ", groups[g].second,
                        groups[g].first);
  }
  return never.empty() ? text : text + fmt::format("; never with {}", never);
}

// A sentence on random points against the best search, at the level of all starts.
std::string RandomVerdict(const std::vector<SearchRow>& rows) {
  const Level& hybrid = kLevels[3];
  std::optional<std::int64_t> random, best;
  bool has_random = false, has_other = false;
  for (const SearchRow& row : rows) {
    const auto enough = EnoughFor(row, hybrid);
    const bool is_random = row.algorithm == ToText(Algorithm::kRandom);
    (is_random ? has_random : has_other) = true;
    if (is_random) {
      random = enough;
    } else if (enough && (!best || *enough < *best)) {
      best = enough;
    }
  }
  if (!has_random || !has_other) return "";
  if (!random && !best) return " Neither random points nor any search get there in every run.";
  if (!random) return " Random points do not get there in every run.";
  if (!best || *random <= *best) return " Random points do as well as any search.";
  return fmt::format(" Random points need {} evaluations where the best search needs {}.", *random,
                     *best);
}

std::vector<Section> BudgetSections(const Comparison& comparison, const ProblemResult& problem) {
  const std::vector<SearchRow> rows = RowsOf(problem);
  const std::string objective = ToText(comparison.options.objective);
  const std::string runs = RunsText(comparison, problem);
  Section section = ProblemSection(comparison, problem);
  for (const Level& level : kLevels) {
    const std::string title = fmt::format(fmt::runtime(level.title), runs);
    AddTable(HitTable(rows, level, fmt::format("{} ({})", title, objective)), &section);
  }
  AddTable(
      EnoughTable(rows, fmt::format("Evaluations from which on every run hits ({})", objective)),
      &section);
  const std::string verdict =
      fmt::format("Search alone: {}. With all starts: {}.{}", WhoFromWhere(rows, kLevels[0]),
                  WhoFromWhere(rows, kLevels[3]), RandomVerdict(rows));
  return {std::move(section), {"", {block::Sentence{verdict}}, 1}};
}

}  // namespace

Document BudgetDocument(const Comparison& comparison) {
  const std::size_t summaries = SummariseProblems(comparison).size();
  std::string where = Plural(comparison.problems.size(), summaries > 0 ? "device" : "problem");
  if (summaries > 0) where += " of " + Plural(summaries, "problem");
  Document document = {CompareBanners(comparison)};
  Section& head = document.head;
  head.heading = fmt::format("lyrefit {}: hits by budget, {} of each algorithm and budget on {}",
                             comparison.version, Plural(comparison.options.runs, "run"), where);
  AddSetUp(comparison, &head);
  AddField("budget",
           "columns are evaluations of one search; its population is about their root, 4 to 100; "
           "the polish comes on top",
           &head);
  AddField("hit",
           summaries > 0
               ? "a run within 1e-6 of the best known optimum of its device; where effects "
                 "have several variants, RMSEs count as BIC prices their parameters"
               : "a run within 1e-6 (search alone) or 1e-9 (polished) of the reference",
           &head);
  AddField("time", Duration(comparison.seconds), &head);
  for (const ProblemResult& problem : comparison.problems) {
    if (problem.problem.empty()) AddSections(BudgetSections(comparison, problem), &document);
  }
  AddSections(ProblemSections(comparison), &document);
  return document;
}

std::string BudgetText(const Comparison& comparison) {
  return DrawText(BudgetDocument(comparison));
}

}  // namespace lyrefit
