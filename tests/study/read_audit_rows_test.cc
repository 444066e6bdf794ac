#include "lyrefit/study/read_audit_rows.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "cases.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

constexpr char kRowsHeader[] =
    "source,device,model,algorithm,rmse_A,Iph_A,Rs_ohm,Rsh_ohm,Is1_A,Is1_uA,n1,Is2_A,n2,"
    "temperature_C,cells,constants,bounds,note\n";

std::string Told(const PrintedNumber& number) {
  return fmt::format("{} is {:.10g} +- {:.6g}", number.text, number.value, number.half_unit);
}

std::string Told(const AuditRow& row) {
  std::string text = fmt::format("line {}: {}, {} (column {}), {}, {}, {} {}", row.line, row.source,
                                 row.device, row.device_column, ToText(row.model), row.algorithm,
                                 row.sum_of_squares ? "sum of squares" : "RMSE", Told(row.rmse));
  for (const PrintedNumber& number : row.parameters) text += "; " + Told(number);
  if (row.objective) text += "; " + ToText(*row.objective);
  if (row.temperature_C) text += fmt::format("; {:.8g} C", *row.temperature_C);
  if (row.cells) text += fmt::format("; {} cells", *row.cells);
  if (row.constants) text += "; constants " + ToText(*row.constants);
  if (!row.bounds.empty())
    text += fmt::format("; bounds {} (column {})", row.bounds, row.bounds_column);
  return text + (row.note.empty() ? "" : "; note '" + row.note + "'");
}

std::string Read(const std::string& text) {
  const TempFolder folder;
  const auto rows = ReadAuditRows(folder.Write("rows.csv", text));
  const auto error = [](Error one) {
    one.file = one.file.substr(one.file.rfind('/') + 1);
    return "error " + one.ToString();
  };
  if (!rows) return error(rows.error());
  std::string told;
  for (const AuditRow& row : rows->rows) told += (told.empty() ? "" : "\n") + Told(row);
  for (const Error& bad : rows->bad_rows) told += (told.empty() ? "" : "\n") + error(bad);
  return told;
}

TEST(ReadAuditRowsTest, KeepsDigitsAndSaysWhereARowIsWrong) {
  CheckCases("audit_rows", {{"table", Read}, {"rows", [](const std::string& rows) {
                                                return Read(kRowsHeader + rows + "\n");
                                              }}});
}

TEST(ReadAuditRowsTest, RefusesAFileThatIsMissing) {
  EXPECT_FALSE(ReadAuditRows(TempFolder().Path("missing.csv")));
}

}  // namespace
}  // namespace lyrefit
