#include "lyrefit/batch/row_text.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

const std::vector<ResultColumn> kColumns = {{"id", "", CellType::kText, "name"},
                                            {"Rs_ohm", "ohm", CellType::kNumber, "resistance"},
                                            {"points", "", CellType::kWhole, "how many"},
                                            {"outlier", "", CellType::kTruth, "whether"},
                                            {"cause", "", CellType::kText, "none here"}};

TEST(RowText, ReadsBackToTheSameBits) {
  const ResultRow row = {{std::string("a,\"b\"\n\xff"), 0.1 + 0.2, std::int64_t{50}, true, {}}};
  const std::string text = RowJson(kColumns, row);
  EXPECT_EQ(text,
            "{\"id\":\"a,\\\"b\\\"\\n\xEF\xBF\xBD\",\"Rs_ohm\":0.30000000000000004,"
            "\"points\":50,\"outlier\":true,\"cause\":null}");
  const ResultRow back = RowOf(kColumns, nlohmann::json::parse(text));
  EXPECT_EQ(RowJson(kColumns, back), text);
  EXPECT_EQ(std::get<double>(back.cells[1]), 0.1 + 0.2);
  EXPECT_EQ(RowCsv(back), "\"a,\"\"b\"\"\n\xEF\xBF\xBD\",0.30000000000000004,50,true,\n");
}

TEST(RowText, OfAWholeNumberInANumbersPlaceIsThatNumber) {
  const ResultRow row = RowOf(kColumns, nlohmann::json::parse(R"({"Rs_ohm":3,"points":"x"})"));
  EXPECT_EQ(std::get<double>(row.cells[1]), 3);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(row.cells[2]));
  EXPECT_EQ(RowCsv(row), ",3,,,\n");
}

TEST(RowText, OfColumnsReadsBack) {
  const auto back = ReadColumns(FieldsJson(kColumns));
  ASSERT_TRUE(back);
  EXPECT_EQ(FieldsJson(*back), FieldsJson(kColumns));
  EXPECT_EQ(HeadCsv(*back), "id,Rs_ohm,points,outlier,cause\n");
  EXPECT_FALSE(ReadColumns(nlohmann::ordered_json::parse(R"([{"name":"a","type":"colour"}])")));
}

}  // namespace
}  // namespace lyrefit
