#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "../error_of.h"
#include "lyrefit/stream/batch_source.h"
#include "temp_folder.h"

namespace lyrefit {

struct ReadItem {
  BatchItem item;
  BatchCurve curve;
};

// All items of one shard. An input that cannot be opened or read to the end fails the test. An
// input without any curve, which ends with an error, has no items.
inline std::vector<ReadItem> ReadBatch(const std::vector<std::string>& inputs,
                                       const BatchReadOptions& options = {}) {
  std::vector<ReadItem> all;
  const auto source = OpenBatch(inputs, options);
  EXPECT_TRUE(source) << MessageOf(source);
  if (!source) return all;
  for (;;) {
    auto item = (*source)->Next();
    if (all.empty() && MessageOf(item) == "expected at least one curve, found none") return all;
    EXPECT_TRUE(item) << MessageOf(item);
    if (!item || !*item) return all;
    EXPECT_EQ((*item)->place, static_cast<std::int64_t>(all.size()));
    EXPECT_LE((*item)->end, (*source)->size());
    BatchCurve curve = (*source)->Read(**item);
    EXPECT_EQ(curve.id, (*item)->id);
    all.push_back({std::move(**item), std::move(curve)});
  }
}

inline std::vector<std::string> IdsOf(const std::vector<ReadItem>& items) {
  std::vector<std::string> ids;
  for (const ReadItem& one : items) ids.push_back(one.curve.id);
  return ids;
}

// "id: ok" or "id: error message".
inline std::vector<std::string> LinesOf(const std::vector<ReadItem>& items) {
  std::vector<std::string> lines;
  for (const ReadItem& one : items) {
    lines.push_back(one.curve.id + ": " +
                    (one.curve.curve ? "ok" : one.curve.curve.error().ToString()));
  }
  return lines;
}

// A row of JSON Lines with a valid curve of five points.
inline std::string GoodRow(const std::string& id) {
  return R"({"id":")" + id +
         R"(","irradiance_W_m2":912,"cell_temperature_C":47,"cells_in_series":60,)"
         R"("voltage_V":[0,10,20,30,36],"current_A":[8.5,8.49,8.4,6,0.1]})";
}

inline const std::vector<double> kVoltage = {0, 10, 20, 30, 36};
inline const std::vector<double> kCurrent = {8.5, 8.49, 8.4, 6, 0.1};

// Expects the curve of GoodRow, in any input shape.
inline void ExpectGood(const BatchCurve& one, const std::string& id) {
  EXPECT_EQ(one.id, id);
  ASSERT_TRUE(one.curve) << MessageOf(one.curve);
  EXPECT_EQ(one.curve->voltage_V, kVoltage);
  EXPECT_EQ(one.curve->current_A, kCurrent);
  EXPECT_EQ(one.curve->conditions.irradiance_W_m2, 912);
  EXPECT_EQ(one.curve->conditions.cell_temperature_K, 47 + 273.15);
  EXPECT_EQ(one.curve->conditions.cells_in_series, 60);
  EXPECT_TRUE(one.curve->irradiance_known && one.curve->temperature_known);
  EXPECT_EQ(one.curve->name, id);
}

}  // namespace lyrefit
