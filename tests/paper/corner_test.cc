#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "cli/run_app.h"
#include "paper/corner_study.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> TableRows(const std::string& page, const std::string& heading) {
  std::istringstream lines(page.substr(page.find("## " + heading)));
  std::vector<std::string> rows;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.rfind("## ", 0) != 0) {
    if (line.rfind("| ", 0) == 0) rows.push_back(line);
  }
  return rows;
}

// The cells of a table row, without surrounding blanks.
std::vector<std::string> Cells(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream text(row.substr(1));
  for (std::string cell; std::getline(text, cell, '|');) {
    cells.push_back(cell.size() > 2 ? cell.substr(1, cell.size() - 2) : "");
  }
  return cells;
}

// No search reaches the optimum by itself; every search reaches it with all starts.
void ExpectEnds(const std::string& page, const std::string& runs, std::size_t searches) {
  std::vector<std::string> rows = TableRows(page, "Where searches end");
  ASSERT_EQ(rows.size(), 1 + searches) << page;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const std::vector<std::string> cells = Cells(rows[r]);
    ASSERT_EQ(cells.size(), 6U) << rows[r];
    EXPECT_EQ(cells[2].rfind("0 / ", 0), 0U) << rows[r];
    EXPECT_EQ(cells[5], runs + " / 0 / 0 / 0") << rows[r];
  }
}

// A small study reproduces the rows of the shipped page on the optimum and has the same pattern of
// search results.
TEST(Pwp201Page, StaysTrue) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const AppResult result = RunApp("'" + DataFolder("paper") + "' --only pwp201 --out '" +
                                  folder.Path("") + "' --pwp201-runs 8 --pwp201-budgets 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = FileText(folder.Path("pwp201.md"));
  const std::string shipped = FileText(DataFolder("paper") + "/pwp201.md");
  EXPECT_FALSE(std::filesystem::exists(folder.Path("README.md")));
  EXPECT_THAT(FileText(folder.Path("pwp201.svg")), HasSubstr("</svg>"));
  EXPECT_EQ(TableRows(page, "What the two optima are"),
            TableRows(shipped, "What the two optima are"));
  const std::vector<std::string> proofs = TableRows(page, "The optimum, proved");
  const std::vector<std::string> shipped_proofs = TableRows(shipped, "The optimum, proved");
  ASSERT_EQ(proofs.size(), 4U);
  ASSERT_EQ(shipped_proofs.size(), 4U);
  for (std::size_t r = 1; r < 4; ++r) {
    EXPECT_EQ(Cells(proofs[r])[1], Cells(shipped_proofs[r])[1]);
    EXPECT_EQ(Cells(proofs[r])[3], "yes");
  }
  const bool peers = page.find("pagmo:cmaes") != std::string::npos;
  ExpectEnds(page, "8", peers ? 11 : 9);
  ExpectEnds(shipped, "30", 21);
}

TEST(Pwp201Page, CountsEndsByWhereTheyLie) {
  CornerStudy study;
  study.certificate.models.resize(2);
  study.certificate.models[0].rmse_A = 2e-3;
  study.certificate.models[1].rmse_A = 1e-3;
  AlgorithmResult compared;
  for (const double end : {1e-3, 1e-3 * (1 + 1e-7), 1.1e-3, 2e-3 * (1 - 2e-6), 2e-3 * (1 - 1e-7),
                           2e-3 * (1 + 1e-7), 2e-3 * (1 + 2e-6), 0.1, kUnknown}) {
    RunRecord run;
    run.searched_A = end;
    compared.runs.push_back(run);
  }
  const CornerEnds ends = CountEnds(study, compared, &RunRecord::searched_A);
  EXPECT_EQ(ends.optimum, 2);
  EXPECT_EQ(ends.between, 2);
  EXPECT_EQ(ends.literature, 2);
  EXPECT_EQ(ends.above, 3);
}

TEST(Pwp201Page, RefusesAnotherName) {
  const AppResult result = RunApp("'" + DataFolder("paper") + "' --only stm6");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err,
              HasSubstr("--only: expected readme, pwp201, proofs, sound or wide, found 'stm6'"));
}

}  // namespace
}  // namespace lyrefit
