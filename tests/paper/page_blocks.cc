#include "paper/page_blocks.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

// Runs that reach the optimum with 10, 1000 and 100000 evaluations.
block::Table BudgetSummary(const PaperStudy& study) {
  block::Table table = {"llrrrr",
                        {{"model", "search", "search alone", "and one plain solve",
                          "and the best candidate's polish", "and all starts"}}};
  for (const ProblemResult& problem : study.budget.problems) {
    std::vector<block::Table::Row> rows;
    for (const AlgorithmResult& compared : problem.algorithms) {
      const std::int64_t budget = std::stoll(compared.name.substr(compared.name.find('@') + 1));
      if (rows.empty() || rows.back()[1] != compared.algorithm) {
        rows.push_back({ToText(problem.model), compared.algorithm, "", "", "", ""});
      }
      if (budget != 10 && budget != 1000 && budget != 100000) continue;
      const int hits[] = {compared.searched.within_1e6, compared.plain_polished.within_1e9,
                          compared.own_polished.within_1e9, compared.polished.within_1e9};
      for (int level = 0; level < 4; ++level) {
        std::string& cell = rows.back()[2 + level];
        cell += (cell.empty() ? "" : " / ") + std::to_string(hits[level]);
      }
    }
    for (block::Table::Row& row : rows) table.rows.push_back(std::move(row));
  }
  return table;
}

// Markdown text of the blocks, with a blank line at the end.
std::string Drawn(std::vector<block::Any> blocks) {
  return DrawMarkdown({{}, {"", std::move(blocks)}}, Texts::kMarkdown) + "\n";
}

}  // namespace

block::Table CertifiedTable(const PaperStudy& study) {
  block::Table table = {
      "lrlrrrr",
      {{"curve", "n in", "diodes of the floor (n)", "floor, any number", "SD", "DD", "TD"}}};
  for (const Certificate& certificate : study.certificates) {
    std::string diodes;
    for (const FloorDiode& diode : certificate.floor.diodes) {
      diodes += (diodes.empty() ? "" : ", ") + fmt::format("{:.4g}", diode.n);
    }
    block::Table::Row row = {
        certificate.curve.name,
        fmt::format("[{:g}, {:g}]", certificate.options.n_lower, certificate.options.n_upper),
        diodes, Scientific(certificate.floor.rmse_A, 10)};
    for (const ModelCertificate& model : certificate.models) {
      const bool attains = model.above_floor <= kCertifiedGap;
      std::string cell = attains ? "= floor" : Scientific(model.rmse_A, 10);
      if (!model.certified) cell += fmt::format(" (gap {:.1e})", model.gap);
      row.push_back(cell);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<block::Any> RankedTables(const PaperStudy& study) {
  std::vector<block::Any> tables;
  for (const ProblemResult& problem : study.ranked.problems) {
    std::vector<std::size_t> order(problem.algorithms.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const std::vector<double>& ranks = problem.searched.friedman.mean_rank;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
    block::Table table = {"lrrrrrr",
                          {{"algorithm", "mean rank, search alone", "min", "mean", "max",
                            "mean rank, polished", "polished runs at the optimum"}}};
    for (const std::size_t i : order) {
      const AlgorithmResult& compared = problem.algorithms[i];
      table.rows.push_back(
          {compared.name, fmt::format("{:.2f}", ranks[i]), Scientific(compared.searched.min, 6),
           Scientific(compared.searched.mean, 6), Scientific(compared.searched.max, 6),
           fmt::format("{:.2f}", problem.polished.friedman.mean_rank[i]),
           fmt::format("{} of {}", compared.polished.within_1e9, compared.runs.size())});
    }
    tables.emplace_back(std::move(table));
  }
  return tables;
}

std::string ReplaceBlock(const std::string& page, const std::string& name,
                         const std::string& block) {
  const std::string first = "<!-- " + name + " -->\n";
  const std::string last = "<!-- end of " + name + " -->";
  const std::size_t begin = page.find(first);
  if (begin == std::string::npos) return page;
  const std::size_t end = page.find(last, begin);
  if (end == std::string::npos) return page;
  return page.substr(0, begin + first.size()) + block + page.substr(end);
}

std::string WithTables(std::string page, const PaperStudy& study) {
  page = ReplaceBlock(page, "certified", Drawn({CertifiedTable(study)}));
  page = ReplaceBlock(page, "ranked", Drawn(RankedTables(study)));
  return ReplaceBlock(page, "budget", Drawn({BudgetSummary(study)}));
}

}  // namespace lyrefit
