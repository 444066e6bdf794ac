#include "paper/proof_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "paper/page_blocks.h"

// All texts in this file are Markdown.
namespace lyrefit {
namespace {

using block::Table;

std::string Gap(const ModelCertificate& proof) {
  const std::string text = proof.gap > 0 ? fmt::format("{:.1e}", proof.gap) : "0";
  return proof.certified ? text : "**" + text + "**";
}

std::string SecondsText(double seconds) {
  return seconds < 10 ? Significant(seconds, 2) : fmt::format("{:.0f}", seconds);
}

// RMSE from a sum of squares.
double RootMean(double sum, int points) { return std::sqrt(std::max(sum, 0.0) / points); }

// The bound of another program for the same curve, model and box; nullptr if there is none.
const ForeignProof* ForeignOf(const ProofTable& table, const ProofRow& row) {
  if (row.box != "literature" || row.options.objective != Objective::kMeasuredCurrent)
    return nullptr;
  for (const ForeignProof& foreign : table.foreign) {
    if (foreign.curve == row.curve && foreign.model == row.proof.model) return &foreign;
  }
  return nullptr;
}

std::string ForeignText(const ForeignProof& foreign, int points) {
  const double best = RootMean(foreign.best_A2, points);
  const double lower = RootMean(foreign.lower_bound_A2, points);
  if (!(lower > 0)) {
    return fmt::format("{}, nothing proved in {:.0f} s", Scientific(best, 7), foreign.seconds);
  }
  return fmt::format("{}, gap {:.1e} in {:.0f} s", Scientific(best, 7), 1 - lower / best,
                     foreign.seconds);
}

Table FullTable(const ProofTable& proofs, Objective objective) {
  const bool measured = objective == Objective::kMeasuredCurrent;
  Table table = {"lllrrrr",
                 {{"curve", "box", "model", "best RMSE (A)", "proved bound (A)", "gap", "s"}}};
  if (measured) {
    table.alignment += "rrl";
    for (const char* head : {"bound, rigorous (A)", "s", "rePVest"}) {
      table.heads[0].emplace_back(head);
    }
  }
  for (const ProofRow& row : proofs.rows) {
    if (row.options.objective != objective) continue;
    Table::Row cells = {row.curve,
                        row.box,
                        ToText(row.proof.model),
                        Scientific(row.proof.rmse_A, 10),
                        BoundText(row.proof.lower_bound_A),
                        Gap(row.proof),
                        SecondsText(row.seconds)};
    if (measured) {
      const ForeignProof* foreign = ForeignOf(proofs, row);
      cells.push_back(BoundText(row.rigorous_lower_A));
      cells.push_back(SecondsText(row.rigorous_seconds));
      cells.push_back(foreign != nullptr ? ForeignText(*foreign, row.points) : "");
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

// One row per curve and model, within the bounds that publications search.
Table ShortTable(const ProofTable& proofs) {
  Table table = {"llrrrrr",
                 {{"curve, box", "model", "measured-current (A)", "gap, s", "solved-current (A)",
                   "gap, s", "rePVest: gap, s"}}};
  for (const ProofRow& row : proofs.rows) {
    const bool only_paper = row.box == "paper" && row.curve == "msx60";
    if (row.box != "literature" && !only_paper) continue;
    const std::string gap = fmt::format("{}, {}", Gap(row.proof), SecondsText(row.seconds));
    if (row.options.objective == Objective::kSolvedCurrent) {
      for (Table::Row& cells : table.rows) {
        if (cells[0] != row.curve + ", " + row.box || cells[1] != ToText(row.proof.model)) continue;
        cells[4] = Scientific(row.proof.rmse_A, 10);
        cells[5] = gap;
      }
      continue;
    }
    Table::Row cells = {row.curve + ", " + row.box,
                        ToText(row.proof.model),
                        Scientific(row.proof.rmse_A, 10),
                        gap,
                        "",
                        "",
                        ""};
    if (const ForeignProof* foreign = ForeignOf(proofs, row)) {
      const double kept = foreign->lower_bound_A2 / foreign->best_A2;
      cells[6] = kept > 0 ? fmt::format("{:.1e}, {:.0f}", 1 - std::sqrt(kept), foreign->seconds)
                          : fmt::format("no bound, {:.0f}", foreign->seconds);
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::string Drawn(std::vector<block::Any> blocks) {
  return DrawMarkdown({{}, {"", std::move(blocks)}}, Texts::kMarkdown) + "\n";
}

// Sentence with the number of complete proofs per objective.
std::string Completeness(const ProofTable& proofs) {
  std::string text;
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    int all = 0, certified = 0;
    for (const ProofRow& row : proofs.rows) {
      if (row.options.objective != objective) continue;
      ++all;
      certified += row.proof.certified ? 1 : 0;
    }
    text += fmt::format("{}{}: {} of {} certified", text.empty() ? "" : "; ", ToText(objective),
                        certified, all);
  }
  return text;
}

std::vector<block::Any> FullBlocks(const ProofTable& proofs) {
  return {block::Sentence{fmt::format(
              "{}. A gap above 1e-9 of the RMSE is left open and printed bold. Seconds are of one "
              "model on one core, its floor included; rePVest's proofs are those of "
              "[its logs](published/README.md#proofs-elsewhere), for the same box.",
              Completeness(proofs))},
          block::Sentence{"Measured-current:"}, FullTable(proofs, Objective::kMeasuredCurrent),
          block::Sentence{"Solved-current:"}, FullTable(proofs, Objective::kSolvedCurrent)};
}

}  // namespace

std::string WithProofs(std::string page, const ProofTable& proofs) {
  page = ReplaceBlock(page, "proofs", Drawn(FullBlocks(proofs)));
  return ReplaceBlock(page, "proofs-short", Drawn({ShortTable(proofs)}));
}

}  // namespace lyrefit
