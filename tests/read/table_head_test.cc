#include "lyrefit/read/table_head.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "cases.h"
#include "read/told.h"

namespace lyrefit {
namespace {

// What the lines of a head state; the first of them is line `number`.
std::string HeadOf(const std::string& text, int number, HeadLine kind) {
  TableHead head;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); ++number) {
    ReadHeadLine(line, number, kind, &head);
  }
  ToldValues told;
  told.Add(Told(head.said));
  told.Add("module cells", head.module_cells);
  told.Add(Told(HeadSentences(head)));
  return told.Text();
}

TEST(ReadHeadLineTest, TakesWhatIsClearlyStatedAndLeavesTheRest) {
  CheckCases(
      "read_heads",
      {{"line", [](const std::string& text) { return HeadOf(text, 3, HeadLine::kText); }},
       {"lines", [](const std::string& text) { return HeadOf(text, 1, HeadLine::kText); }},
       {"comment", [](const std::string& text) { return HeadOf(text, 3, HeadLine::kComment); }}});
}

}  // namespace
}  // namespace lyrefit
