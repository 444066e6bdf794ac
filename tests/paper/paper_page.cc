#include "paper/paper_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/markdown.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/report/audit_text.h"
#include "lyrefit/study/report/compare_sections.h"

namespace lyrefit {
namespace {

using Remarks = std::map<std::string, std::string>;

std::string RemarkText(const Remarks& remarks, const std::string& table) {
  const auto found = remarks.find(table);
  return found == remarks.end() ? "" : Paragraph(found->second);
}

std::string Picture(const std::string& caption, const std::string& file) {
  return fmt::format("![{}]({})\n\n", caption, file);
}

std::string CheckText(const CheckedValue& value) {
  const std::string text = ToText(value.check);
  return value.check == Check::kNotReproduced ? "**" + text + "**" : text;
}

bool Reproduced(const CheckedValue& value) { return value.check == Check::kReproduced; }

// Printed statistics of one table of the paper beside ours.
std::string ValueTable(const PaperStudy& study, const std::string& table) {
  MarkdownTable text("lllrrll");
  text.Add({"curve, model", "algorithm", "figure", "paper", "ours", "99 % range of a batch",
            "reproduced"});
  int count = 0, reproduced = 0;
  for (const CheckedValue& value : study.values) {
    if (value.published.table != table) continue;
    ++count;
    reproduced += Reproduced(value);
    text.Add({value.published.curve + ", " + ToText(value.published.model),
              value.published.algorithm, value.published.quantity, value.published.text,
              Scientific(value.ours, 6),
              Scientific(value.low, 4) + " .. " + Scientific(value.high, 4), CheckText(value)});
  }
  if (count == 0) return "";
  return text.Text() + Paragraph(fmt::format("{} of {} figures reproduced.", reproduced, count));
}

std::string TableSection(const PaperStudy& study, const Remarks& remarks, const std::string& table,
                         const std::string& title) {
  return fmt::format("## {}: {}\n\n", table, title) + RemarkText(remarks, table) +
         ValueTable(study, table);
}

// Tables 17 and 18 as the paper lays them out: paper / ours.
std::string RateGrid(const PaperStudy& study, const std::string& table) {
  MarkdownTable text("lrrrrr");
  std::vector<std::string> head = {"paper / ours"}, row;
  std::string row_name;
  std::vector<std::vector<std::string>> rows;
  for (const CheckedValue& value : study.values) {
    if (value.published.table != table) continue;
    const std::string& name = value.published.algorithm;
    const std::size_t blank = name.find(' ');
    if (name.substr(0, blank) != row_name) {
      if (!row.empty()) rows.push_back(row);
      row_name = name.substr(0, blank);
      row = {row_name};
    }
    if (rows.empty()) head.push_back(name.substr(blank + 1));
    const std::string ours = Scientific(value.ours, 4);
    row.push_back(value.published.text + " / " + (Reproduced(value) ? "**" + ours + "**" : ours));
  }
  if (row.empty()) return "";
  rows.push_back(row);
  text.Add(head);
  for (auto& one : rows) text.Add(std::move(one));
  return text.Text();
}

std::string GridSection(const PaperStudy& study, const Remarks& remarks) {
  std::string text = "## Tables 17 and 18: sensitivity to Pm and gamma\n\n";
  text += RemarkText(remarks, "Table 17");
  text +=
      "Mean of the searched RMSE (Table 17; ours in bold where the paper's figure lies in the "
      "range of a batch):\n\n";
  text += RateGrid(study, "Table 17");
  text += "Standard deviation (Table 18):\n\n" + RateGrid(study, "Table 18");
  int count = 0, reproduced = 0;
  for (const CheckedValue& value : study.values) {
    if (value.published.table != "Table 17" && value.published.table != "Table 18") continue;
    ++count;
    reproduced += Reproduced(value);
  }
  return text + Paragraph(fmt::format("{} of {} cells reproduced.", reproduced, count));
}

// Printed statistics of points that nobody has, beside ours on others: no verdict.
std::string S75Values(const PaperStudy& study, const std::string& table) {
  MarkdownTable text("lllrrl");
  text.Add({"curve, model", "algorithm", "figure", "paper", "ours", "99 % range of a batch"});
  for (const CheckedValue& value : study.s75_values) {
    if (value.published.table != table) continue;
    text.Add({value.published.curve + ", " + ToText(value.published.model),
              value.published.algorithm, value.published.quantity, value.published.text,
              Scientific(value.ours, 6),
              Scientific(value.low, 4) + " .. " + Scientific(value.high, 4)});
  }
  return text.Text();
}

// The same searches with the polish behind them, which the paper has not.
std::string S75Table(const PaperStudy& study) {
  MarkdownTable table("llrrrrrrr");
  table.Add({"curve", "algorithm", "min", "mean", "median", "max", "std", "polished, min and max",
             "polished runs at the optimum"});
  for (const ProblemResult& problem : study.s75.problems) {
    for (const ContenderResult& contender : problem.contenders) {
      const Spread& s = contender.searched;
      table.Add(
          {problem.curve_name, contender.name, Scientific(s.min, 5), Scientific(s.mean, 5),
           Scientific(s.median, 5), Scientific(s.max, 5), Scientific(s.std, 2),
           Scientific(contender.polished.min, 5) + ", " + Scientific(contender.polished.max, 5),
           fmt::format("{} of {}", contender.polished.within_1e9, contender.runs.size())});
    }
  }
  return Paragraph("All runs on the constructed family, searched and polished:") + table.Text();
}

std::string MachineSection(const PaperStudy& study, const Remarks& remarks) {
  const auto printed = [&](const std::string& algorithm, const std::string& quantity) {
    for (const PublishedValue& value : study.machine) {
      if (value.algorithm == algorithm && value.quantity == quantity) return value;
    }
    return PublishedValue{};
  };
  std::string text = "## Table 9: budget, time and memory, MSX-60, three diodes\n\n";
  text += RemarkText(remarks, "Table 9");
  MarkdownTable table("lrrrrrr");
  table.Add(
      {"algorithm", "evaluations, paper", "ours", "seconds, paper", "ours", "MB, paper", "ours"});
  for (const TimedSearch& timed : study.timed) {
    table.Add({timed.algorithm, printed(timed.algorithm, "evaluations").text,
               std::to_string(timed.evaluations), printed(timed.algorithm, "seconds").text,
               Significant(timed.seconds, 3), printed(timed.algorithm, "memory_MB").text,
               timed.memory_MB > 0 ? Significant(timed.memory_MB, 3) : "-"});
  }
  return text + table.Text();
}

std::string AuditSection(const PaperStudy& study, const Remarks& remarks) {
  std::string text = "## Printed parameters: Tables 3, 5, 7, 10 and 11\n\n";
  text += RemarkText(remarks, "rows");
  return text + "```text\n" + AuditText(study.audit) + "```\n\n";
}

std::string RankSectionOf(const PaperStudy& study, const Remarks& remarks) {
  std::string text = "## Tables 13 to 15: who ranks first, and what the polish leaves of it\n\n";
  text += RemarkText(remarks, "Table 13") + RankedTable(study);
  for (const ProblemResult& problem : study.ranked.problems) {
    text += "```text\n" + RankSection(problem) + "\n" + PolishVerdict(problem) + "```\n\n";
  }
  text += Picture("RMSE of every run, searched and polished", "ranked.svg");
  return text + Picture("Median best so far", "ranked-convergence.svg");
}

std::string Introduction(const PaperStudy& study) {
  const PaperStudyOptions& options = study.options;
  return "# The modified-lyrebird paper, done again\n\n" +
         Paragraph(
             "J. Ind. Manag. Optim. 22(1), 642-690, fits one, two and three diodes to the MSX-60 "
             "module, the RTC France cell and the Shell S75 module. This page holds its figures "
             "against lyrefit's own "
             "runs. It is written by one command, `cmake/results.sh`, from `published.csv` and "
             "`rows.csv` (what the paper prints), `remarks.csv` and the curves in the folders "
             "beside this one; `about.md` says what was transcribed.") +
         Paragraph(fmt::format(
             "A statistic of {} runs depends on chance, so ours come as {} batches of {} runs each "
             "(grid of Pm and gamma, S75: {} batches): `ours` is their geometric mean, and a "
             "printed "
             "figure counts as reproduced if it lies in the range that one more batch would fall "
             "into 99 times of 100. {} birds x {} iterations, seed {}; every RMSE is of the "
             "measured-current residual, in A; "
             "constants of the literature. lyrefit {}.",
             options.batch, options.batches, options.batch, options.sensitivity_batches,
             options.population, options.iterations, options.seed, study.version));
}

// One line a table of the paper.
std::string Overview(const PaperStudy& study) {
  std::map<std::string, std::pair<int, int>> counts;
  std::vector<std::string> order;
  for (const CheckedValue& value : study.values) {
    auto& [reproduced, count] = counts[value.published.table];
    if (count++ == 0) order.push_back(value.published.table);
    reproduced += Reproduced(value);
  }
  MarkdownTable table("lrr");
  table.Add({"table", "figures of repeated runs", "reproduced"});
  for (const std::string& name : order) {
    table.Add({name, std::to_string(counts[name].second), std::to_string(counts[name].first)});
  }
  std::map<std::string, int> others;
  for (const CheckedValue& value : study.s75_values) ++others[value.published.table];
  for (const auto& [name, count] : others) {
    table.Add({name, std::to_string(count), "points not published"});
  }
  return table.Text();
}

std::string BudgetTable(const PaperStudy& study) {
  std::string text;
  for (const ProblemResult& problem : study.budget.problems) {
    std::vector<std::string> head = {"algorithm"};
    std::vector<std::vector<std::string>> rows;
    for (const ContenderResult& contender : problem.contenders) {
      const std::string budget = contender.name.substr(contender.name.find('@') + 1);
      if (rows.empty() || rows.back()[0] != contender.algorithm) {
        rows.push_back({contender.algorithm});
      }
      if (rows.size() == 1) head.push_back(budget);
      rows.back().push_back(fmt::format(
          "{} / {} / {} / {}", contender.searched.within_1e6, contender.plain_polished.within_1e9,
          contender.own_polished.within_1e9, contender.polished.within_1e9));
    }
    MarkdownTable table("l" + std::string(head.size() - 1, 'r'));
    table.Add(head);
    for (auto& row : rows) table.Add(std::move(row));
    text += ProblemTitle(problem) + ":\n\n" + table.Text();
  }
  return text;
}

}  // namespace

std::string CertifiedTable(const PaperStudy& study) {
  MarkdownTable table("lrlrrrr");
  table.Add({"curve", "n in", "diodes of the floor (n)", "floor, any number", "SD", "DD", "TD"});
  for (const Certificate& certificate : study.certificates) {
    std::string diodes;
    for (const FloorDiode& diode : certificate.floor.diodes) {
      diodes += (diodes.empty() ? "" : ", ") + fmt::format("{:.4g}", diode.n);
    }
    std::vector<std::string> row = {
        certificate.curve.name,
        fmt::format("[{:g}, {:g}]", certificate.options.n_lower, certificate.options.n_upper),
        diodes, Scientific(certificate.floor.rmse_A, 10)};
    for (const ModelCertificate& model : certificate.models) {
      const bool attains = model.above_floor <= kCertifiedGap;
      std::string cell = attains ? "= floor" : Scientific(model.rmse_A, 10);
      if (!model.certified) cell += fmt::format(" (gap {:.1e})", model.gap);
      row.push_back(cell);
    }
    table.Add(row);
  }
  return table.Text();
}

std::string BudgetSummary(const PaperStudy& study) {
  MarkdownTable table("llrrrr");
  table.Add({"model", "search", "search alone", "and one plain solve", "and the best bird's polish",
             "and all starts"});
  for (const ProblemResult& problem : study.budget.problems) {
    std::vector<std::vector<std::string>> rows;
    for (const ContenderResult& contender : problem.contenders) {
      const std::int64_t budget = std::stoll(contender.name.substr(contender.name.find('@') + 1));
      if (rows.empty() || rows.back()[1] != contender.algorithm) {
        rows.push_back({ToText(problem.model), contender.algorithm, "", "", "", ""});
      }
      if (budget != 10 && budget != 1000 && budget != 100000) continue;
      const int hits[] = {contender.searched.within_1e6, contender.plain_polished.within_1e9,
                          contender.own_polished.within_1e9, contender.polished.within_1e9};
      for (int level = 0; level < 4; ++level) {
        std::string& cell = rows.back()[2 + level];
        cell += (cell.empty() ? "" : " / ") + std::to_string(hits[level]);
      }
    }
    for (auto& row : rows) table.Add(std::move(row));
  }
  return table.Text();
}

std::string RankedTable(const PaperStudy& study) {
  std::string text;
  for (const ProblemResult& problem : study.ranked.problems) {
    std::vector<std::size_t> order(problem.contenders.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const std::vector<double>& ranks = problem.searched.friedman.mean_rank;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
    MarkdownTable table("lrrrrrr");
    table.Add({"algorithm", "mean rank, search alone", "min", "mean", "max", "mean rank, polished",
               "polished runs at the optimum"});
    for (const std::size_t i : order) {
      const ContenderResult& contender = problem.contenders[i];
      table.Add({contender.name, fmt::format("{:.2f}", ranks[i]),
                 Scientific(contender.searched.min, 6), Scientific(contender.searched.mean, 6),
                 Scientific(contender.searched.max, 6),
                 fmt::format("{:.2f}", problem.polished.friedman.mean_rank[i]),
                 fmt::format("{} of {}", contender.polished.within_1e9, contender.runs.size())});
    }
    text += table.Text();
  }
  return text;
}

std::string PaperPage(const PaperStudy& study, const Remarks& remarks) {
  std::string text = Introduction(study) + Overview(study);
  text += AuditSection(study, remarks);
  text += TableSection(study, remarks, "Table 3", "MSX-60, one diode");
  text += TableSection(study, remarks, "Table 5", "MSX-60, two diodes");
  text += TableSection(study, remarks, "Table 7", "MSX-60, three diodes");
  text += Picture("Figs. 5, 9, 13: every run on MSX-60", "msx60.svg");
  text += Picture("Figs. 6, 10, 14: convergence on MSX-60", "msx60-convergence.svg");
  text += MachineSection(study, remarks);
  text += TableSection(study, remarks, "Table 10", "RTC France, one diode");
  text += TableSection(study, remarks, "Table 11", "RTC France, two diodes");
  text += TableSection(study, remarks, "Table 12", "RTC France, three diodes");
  text += Picture("Fig. 24: convergence on RTC France", "rtc_france-convergence.svg");
  text += RankSectionOf(study, remarks);
  text += TableSection(study, remarks, "Table 16", "ablation, RTC France, three diodes");
  text += GridSection(study, remarks);
  text += TableSection(study, remarks, "Table 19", "Shell S75, irradiances at 25 C");
  text += S75Values(study, "Table 19");
  text += TableSection(study, remarks, "Table 20", "Shell S75, temperatures at 1000 W/m2");
  text += S75Values(study, "Table 20");
  text += S75Table(study) + RemarkText(remarks, "field");
  text += "## What no paper of the kind prints\n\n### Success against budget\n\n";
  text += RemarkText(remarks, "budget") + BudgetTable(study);
  text += Picture("Runs that reach the optimum against evaluations", "budget.svg");
  text +=
      "### How low the RMSE can go\n\n" + RemarkText(remarks, "certified") + CertifiedTable(study);
  return text;
}

}  // namespace lyrefit
