#include "paper/paper_page.h"

#include <fmt/format.h>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/documents.h"
#include "paper/page_blocks.h"

// All texts in this file are Markdown, as are the remarks in remarks.csv.
namespace lyrefit {
namespace {

using Remarks = std::map<std::string, std::string>;
using block::Table;

void AddRemark(const Remarks& remarks, const std::string& table, Section* section) {
  const auto found = remarks.find(table);
  if (found != remarks.end()) AddSentence(found->second, section);
}

// The command that runs one batch of a table, or the commands, which " ; " parts.
void AddCommand(const Remarks& remarks, const std::string& table, Section* section) {
  const auto found = remarks.find(table + ": command");
  if (found == remarks.end()) return;
  std::string lines = found->second;
  for (std::size_t at = 0; (at = lines.find(" ; ")) != std::string::npos;)
    lines.replace(at, 3, "\n");
  section->blocks.push_back(block::Preformatted{lines + "\n"});
}

void AddPicture(const std::string& caption, const std::string& file, Section* section) {
  section->blocks.push_back(block::Figure{caption, file});
}

std::string CheckText(const CheckedValue& value) {
  const std::string text = ToText(value.check);
  return value.check == Check::kNotReproduced ? "**" + text + "**" : text;
}

bool Reproduced(const CheckedValue& value) { return value.check == Check::kReproduced; }

// A row with a printed statistic and the computed one.
Table::Row ValueRow(const CheckedValue& value) {
  return {value.published.curve + ", " + ToText(value.published.model),
          value.published.algorithm,
          value.published.quantity,
          value.published.text,
          Scientific(value.ours, 6),
          Scientific(value.low, 4) + " .. " + Scientific(value.high, 4)};
}

Section TableSection(const PaperStudy& study, const Remarks& remarks, const std::string& name,
                     const std::string& title) {
  Section section = {name + ": " + title};
  AddRemark(remarks, name, &section);
  Table table = {"lllrrll",
                 {{"curve, model", "algorithm", "figure", "paper", "ours", "99 % range of a batch",
                   "reproduced"}}};
  int reproduced = 0;
  for (const CheckedValue& value : study.values) {
    if (value.published.table != name) continue;
    reproduced += Reproduced(value);
    table.rows.push_back(ValueRow(value));
    table.rows.back().push_back(CheckText(value));
  }
  if (table.rows.empty()) return section;
  const std::string count =
      fmt::format("{} of {} figures reproduced.", reproduced, table.rows.size());
  AddTable(std::move(table), &section);
  AddSentence(count, &section);
  AddCommand(remarks, name, &section);
  return section;
}

// Tables 17 and 18 in the layout of the paper; cells are "paper / ours".
void AddRateGrid(const PaperStudy& study, const std::string& name, Section* section) {
  Table table = {"lrrrrr", {{"paper / ours"}}};
  for (const CheckedValue& value : study.values) {
    if (value.published.table != name) continue;
    const std::string& setting = value.published.algorithm;
    const std::size_t blank = setting.find(' ');
    const std::string rate = setting.substr(0, blank);
    if (table.rows.empty() || table.rows.back()[0] != rate) table.rows.push_back({rate});
    if (table.rows.size() == 1) table.heads[0].push_back(setting.substr(blank + 1));
    const std::string ours = Scientific(value.ours, 4);
    table.rows.back().push_back(value.published.text + " / " +
                                (Reproduced(value) ? "**" + ours + "**" : ours));
  }
  if (!table.rows.empty()) AddTable(std::move(table), section);
}

Section GridSection(const PaperStudy& study, const Remarks& remarks) {
  Section section = {"Tables 17 and 18: sensitivity to Pm and gamma"};
  AddRemark(remarks, "Table 17", &section);
  AddSentence(
      "Mean of the searched RMSE (Table 17; ours in bold where the paper's figure lies in the "
      "range of a batch):",
      &section);
  AddRateGrid(study, "Table 17", &section);
  AddSentence("Standard deviation (Table 18):", &section);
  AddRateGrid(study, "Table 18", &section);
  int count = 0, reproduced = 0;
  for (const CheckedValue& value : study.values) {
    if (value.published.table != "Table 17" && value.published.table != "Table 18") continue;
    ++count;
    reproduced += Reproduced(value);
  }
  AddSentence(fmt::format("{} of {} cells reproduced.", reproduced, count), &section);
  AddCommand(remarks, "Table 17", &section);
  return section;
}

// Printed statistics of unpublished points beside computed ones of other points, without a verdict.
Section S75Section(const PaperStudy& study, const Remarks& remarks, const std::string& name,
                   const std::string& title) {
  Section section = TableSection(study, remarks, name, title);
  Table table = {
      "lllrrl",
      {{"curve, model", "algorithm", "figure", "paper", "ours", "99 % range of a batch"}}};
  for (const CheckedValue& value : study.s75_values) {
    if (value.published.table == name) table.rows.push_back(ValueRow(value));
  }
  AddTable(std::move(table), &section);
  AddCommand(remarks, name, &section);
  return section;
}

// Table of the S75 searches with the polish, which the paper does not use.
void AddS75Runs(const PaperStudy& study, Section* section) {
  Table table = {"llrrrrrrr",
                 {{"curve", "algorithm", "min", "mean", "median", "max", "std",
                   "polished, min and max", "polished runs at the optimum"}}};
  for (const ProblemResult& problem : study.s75.problems) {
    for (const AlgorithmResult& compared : problem.algorithms) {
      const RunSpread& s = compared.searched;
      table.rows.push_back(
          {problem.curve_name, compared.name, Scientific(s.min, 5), Scientific(s.mean, 5),
           Scientific(s.median, 5), Scientific(s.max, 5), Scientific(s.std, 2),
           Scientific(compared.polished.min, 5) + ", " + Scientific(compared.polished.max, 5),
           fmt::format("{} of {}", compared.polished.within_1e9, compared.runs.size())});
    }
  }
  AddSentence("All runs on the constructed family, searched and polished:", section);
  AddTable(std::move(table), section);
}

Section MachineSection(const PaperStudy& study, const Remarks& remarks) {
  const auto printed = [&](const std::string& algorithm, const std::string& quantity) {
    for (const PublishedValue& value : study.machine) {
      if (value.algorithm == algorithm && value.quantity == quantity) return value;
    }
    return PublishedValue{};
  };
  Section section = {"Table 9: budget, time and memory, MSX-60, three diodes"};
  AddRemark(remarks, "Table 9", &section);
  Table table = {
      "lrrrrrr",
      {{"algorithm", "evaluations, paper", "ours", "seconds, paper", "ours", "MB, paper", "ours"}}};
  for (const TimedSearch& timed : study.timed) {
    table.rows.push_back({timed.algorithm, printed(timed.algorithm, "evaluations").text,
                          std::to_string(timed.evaluations),
                          printed(timed.algorithm, "seconds").text, Significant(timed.seconds, 3),
                          printed(timed.algorithm, "memory_MB").text,
                          timed.memory_MB > 0 ? Significant(timed.memory_MB, 3) : "-"});
  }
  AddTable(std::move(table), &section);
  AddCommand(remarks, "Table 9", &section);
  return section;
}

Section AuditSection(const PaperStudy& study, const Remarks& remarks) {
  Section section = {"Printed parameters: Tables 3, 5, 7, 10 and 11"};
  AddRemark(remarks, "rows", &section);
  section.blocks.push_back(block::Preformatted{AuditText(study.audit)});
  return section;
}

Section RankedSection(const PaperStudy& study, const Remarks& remarks) {
  Section section = {"Tables 13 to 15: who ranks first, and what the polish leaves of it"};
  AddRemark(remarks, "Table 13", &section);
  for (block::Any& table : RankedTables(study)) section.blocks.push_back(std::move(table));
  AddCommand(remarks, "Table 13", &section);
  for (const ProblemResult& problem : study.ranked.problems) {
    Document ranks;
    AddSections({RankSection(problem), PolishVerdict(problem)}, &ranks);
    section.blocks.push_back(block::Preformatted{DrawText(ranks)});
  }
  AddPicture("RMSE of every run, searched and polished", "ranked.svg", &section);
  AddPicture("Median best so far", "ranked-convergence.svg", &section);
  return section;
}

// One row per table of the paper.
Table Overview(const PaperStudy& study) {
  std::map<std::string, std::pair<int, int>> counts;
  std::vector<std::string> order;
  for (const CheckedValue& value : study.values) {
    auto& [reproduced, count] = counts[value.published.table];
    if (count++ == 0) order.push_back(value.published.table);
    reproduced += Reproduced(value);
  }
  Table table = {"lrr", {{"table", "figures of repeated runs", "reproduced"}}};
  for (const std::string& name : order) {
    table.rows.push_back(
        {name, std::to_string(counts[name].second), std::to_string(counts[name].first)});
  }
  std::map<std::string, int> others;
  for (const CheckedValue& value : study.s75_values) ++others[value.published.table];
  for (const auto& [name, count] : others) {
    table.rows.push_back({name, std::to_string(count), "points not published"});
  }
  return table;
}

Section Introduction(const PaperStudy& study) {
  const PaperStudyOptions& options = study.options;
  Section section = {"The modified-lyrebird paper, done again"};
  AddSentence(
      "J. Ind. Manag. Optim. 22(1), 642-690, fits one, two and three diodes to the MSX-60 module, "
      "the RTC France cell and the Shell S75 module. This page holds its figures against lyrefit's "
      "own runs. It is written by one command, `cmake/results.sh`, from `published.csv` and "
      "`rows.csv` (what the paper prints), `remarks.csv` and the curves in the folders beside this "
      "one; `about.md` says what was transcribed.",
      &section);
  AddSentence(
      fmt::format(
          "A statistic of {} runs depends on chance. So ours come as {} batches of {} runs each "
          "(grid of Pm and gamma, S75: {} batches). `ours` is their geometric mean. A printed "
          "figure counts as reproduced if it lies in the range that one more batch would fall into "
          "99 times of 100. A search has {} candidates x {} iterations, and the seed is {}. Every "
          "RMSE is of the measured-current residual, in A. The constants are the literature's. The "
          "command under a table runs its first batch. This page was made by lyrefit {}.",
          options.batch, options.batches, options.batch, options.sensitivity_batches,
          options.population, options.iterations, options.seed, study.version),
      &section);
  AddTable(Overview(study), &section);
  return section;
}

Section BudgetSection(const PaperStudy& study, const Remarks& remarks) {
  Section section = {"Success against budget", {}, 1};
  AddRemark(remarks, "budget", &section);
  for (const ProblemResult& problem : study.budget.problems) {
    Table table = {"l", {{"algorithm"}}};
    for (const AlgorithmResult& compared : problem.algorithms) {
      const std::string budget = compared.name.substr(compared.name.find('@') + 1);
      if (table.rows.empty() || table.rows.back()[0] != compared.algorithm) {
        table.rows.push_back({compared.algorithm});
      }
      if (table.rows.size() == 1) {
        table.heads[0].push_back(budget);
        table.alignment += 'r';
      }
      table.rows.back().push_back(fmt::format(
          "{} / {} / {} / {}", compared.searched.within_1e6, compared.plain_polished.within_1e9,
          compared.own_polished.within_1e9, compared.polished.within_1e9));
    }
    AddSentence(ProblemTitle(problem) + ":", &section);
    AddTable(std::move(table), &section);
  }
  AddCommand(remarks, "budget", &section);
  AddPicture("Runs that reach the optimum against evaluations", "budget.svg", &section);
  return section;
}

Section CertifiedSection(const PaperStudy& study, const Remarks& remarks) {
  Section section = {"How low the RMSE can go", {}, 1};
  AddRemark(remarks, "certified", &section);
  AddTable(CertifiedTable(study), &section);
  AddCommand(remarks, "certified", &section);
  return section;
}

}  // namespace

std::string PaperPage(const PaperStudy& study, const Remarks& remarks) {
  Document page;
  page.head = Introduction(study);
  const auto table = [&](const std::string& name, const std::string& title) {
    return TableSection(study, remarks, name, title);
  };
  Section msx60 = table("Table 7", "MSX-60, three diodes");
  AddPicture("Figs. 5, 9, 13: every run on MSX-60", "msx60.svg", &msx60);
  AddPicture("Figs. 6, 10, 14: convergence on MSX-60", "msx60-convergence.svg", &msx60);
  Section rtc_france = table("Table 12", "RTC France, three diodes");
  AddPicture("Fig. 24: convergence on RTC France", "rtc_france-convergence.svg", &rtc_france);
  Section s75 = S75Section(study, remarks, "Table 20", "Shell S75, temperatures at 1000 W/m2");
  AddS75Runs(study, &s75);
  AddRemark(remarks, "field", &s75);
  page.sections = {AuditSection(study, remarks),
                   table("Table 3", "MSX-60, one diode"),
                   table("Table 5", "MSX-60, two diodes"),
                   msx60,
                   MachineSection(study, remarks),
                   table("Table 10", "RTC France, one diode"),
                   table("Table 11", "RTC France, two diodes"),
                   rtc_france,
                   RankedSection(study, remarks),
                   table("Table 16", "ablation, RTC France, three diodes"),
                   GridSection(study, remarks),
                   S75Section(study, remarks, "Table 19", "Shell S75, irradiances at 25 C"),
                   s75,
                   {"What no paper of the kind prints"},
                   BudgetSection(study, remarks),
                   CertifiedSection(study, remarks)};
  return DrawMarkdown(page, Texts::kMarkdown);
}

}  // namespace lyrefit
