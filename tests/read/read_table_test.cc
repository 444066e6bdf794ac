#include "lyrefit/read/read_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cases.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/table_layout.h"
#include "read/told.h"

namespace lyrefit {
namespace {

std::string Told(const TableLayout& layout) {
  ToldValues told;
  told.Add(fmt::format("'{}', {} lines before", layout.delimiter, layout.first_row_line));
  const auto add = [&](const char* name, int place) {
    if (place == kNoColumn) return;
    const double factor = layout.columns[place].factor;
    told.Add(
        fmt::format("{} {}{}", name, place, factor == 1 ? "" : fmt::format(" x {:.6g}", factor)));
  };
  add("V", layout.voltage);
  add("I", layout.current);
  add("sigma", layout.sigma);
  add("time", layout.time);
  add("sweep", layout.sweep);
  add("W/m2", layout.irradiance);
  add("C", layout.temperature);
  told.Add(Told(layout.head.said));
  told.Add(Told(layout.assumptions));
  return told.Text();
}

TEST(ReadTableTest, ReadsWhatIsWrittenAndRefusesTheRest) {
  CheckCases("read_tables",
             {{"layout",
               [](const std::string& given) {
                 const auto [text, options] = WithOptions(given);
                 const auto layout = FindTableLayout(text, "f", options);
                 return layout ? Told(*layout) : "error " + layout.error().ToString();
               }},
              {"table",
               [](const std::string& given) {
                 const auto [text, options] = WithOptions(given);
                 const auto table = ReadTable(text, "f", options);
                 return ToldOrError(table) +
                        (table && !std::is_sorted(table->lines.begin(), table->lines.end())
                             ? "; lines " + Numbers(table->lines)
                             : "");
               }},
              {"tables",
               [](const std::string& given) {
                 const auto [text, options] = WithOptions(given);
                 return ToldOrError(ReadTables(text, "f", options, BrokenRows::kRefuse));
               }},
              {"rewritten", [](const std::string& text) -> std::string {
                 const DecodedText now = RewriteTable({text, "as it was"});
                 if (now.text == text && now.remark == "as it was") return "the same";
                 return now.remark + ", " + ToText(now.setup) + ":\n" + now.text;
               }}});
}

}  // namespace
}  // namespace lyrefit
