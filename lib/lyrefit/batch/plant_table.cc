#include "lyrefit/batch/plant_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "lyrefit/report/page_shell.h"

namespace lyrefit {
namespace {

using Json = nlohmann::ordered_json;
enum Kind : char { kDoubles, kDecimals, kTexts, kWords };
// 2^52, below the limit of exact integers in a browser (2^53).
constexpr double kLargestCode = 4503599627370496.0;
constexpr int kMostDecimals = 22;  // 10^22 is exact as a double, 10^23 is not

double TenTo(int n) {
  static constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                       1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  return kPowers[n];
}

double Rounded(double value, int digits) {
  if (digits <= 0 || !std::isfinite(value)) return value;
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific,
                                 std::min(digits, 17) - 1);
  std::from_chars(text, end.ptr, value);
  return value;
}

double NumberOf(const ResultCell& cell, int digits) {
  if (const double* number = std::get_if<double>(&cell)) return Rounded(*number, digits);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  if (const bool* truth = std::get_if<bool>(&cell)) return *truth ? 1 : 0;
  return std::numeric_limits<double>::quiet_NaN();
}

// Bytes of the same significance in sequence. Similar numbers then compress well.
std::string Planes(const std::vector<std::uint64_t>& codes, int width) {
  std::string bytes;
  bytes.reserve(codes.size() * width);
  for (int plane = 0; plane < width; ++plane) {
    for (const std::uint64_t code : codes) {
      bytes += static_cast<char>(code >> (8 * plane) & 0xff);
    }
  }
  return bytes;
}

int WidthOf(std::uint64_t largest) {
  int width = 1;
  while (largest >>= 8) ++width;
  return width;
}

// Number of decimals that represents every value exactly; empty if there is none.
std::optional<int> DecimalsOf(const std::vector<double>& values) {
  int decimals = 0;
  double largest = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    largest = std::max(largest, std::fabs(value));
    while (largest * TenTo(decimals) < kLargestCode / 4 &&
           std::round(value * TenTo(decimals)) / TenTo(decimals) != value) {
      if (++decimals > kMostDecimals) return std::nullopt;
    }
    if (!(largest * TenTo(decimals) < kLargestCode / 4)) return std::nullopt;
  }
  return decimals;
}

std::string PackNumbers(const std::vector<double>& values) {
  std::vector<std::uint64_t> codes(values.size(), 0);
  const std::optional<int> decimals = DecimalsOf(values);
  if (!decimals) {
    static_assert(sizeof(double) == sizeof(std::uint64_t));
    std::memcpy(codes.data(), values.data(), values.size() * sizeof(double));
    return std::string(1, kDoubles) + Planes(codes, 8);
  }
  std::uint64_t largest = 0;
  for (std::size_t r = 0; r < values.size(); ++r) {
    if (std::isnan(values[r])) continue;
    const double k = std::round(values[r] * TenTo(*decimals));
    codes[r] = static_cast<std::uint64_t>(k >= 0 ? 2 * k : -2 * k - 1) + 1;
    largest = std::max(largest, codes[r]);
  }
  const int width = WidthOf(largest);
  return std::string{kDecimals, static_cast<char>(*decimals), static_cast<char>(width)} +
         Planes(codes, width);
}

Json TextOf(const ResultCell& cell) {
  const std::string* text = std::get_if<std::string>(&cell);
  return text ? Json(*text) : Json();
}

std::string JsonText(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Words if texts are repeated, else the texts themselves.
std::string PackTexts(const std::vector<ResultCell>& cells) {
  Json words = Json::array();
  std::map<std::string, std::uint64_t> places;
  std::optional<std::uint64_t> unknown;
  std::vector<std::uint64_t> codes;
  for (const ResultCell& cell : cells) {
    const std::string* text = std::get_if<std::string>(&cell);
    std::uint64_t place = words.size();
    if (text) {
      place = places.emplace(*text, place).first->second;
    } else {
      place = unknown.value_or(place);
      unknown = place;
    }
    if (place == words.size()) words.push_back(TextOf(cell));
    codes.push_back(place);
  }
  if (words.size() > cells.size() / 2 + 1) {
    Json texts = Json::array();
    for (const ResultCell& cell : cells) texts.push_back(TextOf(cell));
    return std::string(1, kTexts) + JsonText(texts);
  }
  const int width = WidthOf(words.size());
  const std::string text = JsonText(words);
  std::string bytes{kWords, static_cast<char>(width)};
  for (int b = 0; b < 4; ++b) bytes += static_cast<char>(text.size() >> (8 * b) & 0xff);
  return bytes + text + Planes(codes, width);
}

std::vector<double> Numbers(const std::vector<ResultCell>& cells, int digits) {
  std::vector<double> values;
  values.reserve(cells.size());
  for (const ResultCell& cell : cells) values.push_back(NumberOf(cell, digits));
  return values;
}

const char* TypeName(CellType type) {
  switch (type) {
    case CellType::kText:
      return "text";
    case CellType::kNumber:
      return "number";
    case CellType::kWhole:
      return "whole";
    case CellType::kTruth:
      return "truth";
  }
  return "text";
}

}  // namespace

PlantTable::PlantTable(std::vector<ResultColumn> columns, int digits)
    : columns_(std::move(columns)), digits_(digits), cells_(columns_.size()) {}

bool PlantTable::Add(const ResultRow& row) {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    cells_[c].push_back(c < row.cells.size() ? row.cells[c] : ResultCell());
  }
  if (groups_.empty() || groups_.back().parts.size() == columns_.size()) groups_.emplace_back();
  return ++groups_.back().rows == kPlantGroupRows;
}

std::string PlantTable::TakeGroup() {
  std::string text;
  if (groups_.empty() || !groups_.back().parts.empty()) return text;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const std::string part = Base64(Gzipped(columns_[c].type == CellType::kText
                                                ? PackTexts(cells_[c])
                                                : PackNumbers(Numbers(cells_[c], digits_))));
    groups_.back().parts.push_back(part.size());
    text += part;
    cells_[c].clear();
  }
  return text;
}

std::string PlantTable::Index() const {
  Json index = {{"columns", Json::array()}, {"groups", Json::array()}};
  for (const ResultColumn& column : columns_) {
    index["columns"].push_back({{"name", column.name},
                                {"unit", column.unit},
                                {"type", TypeName(column.type)},
                                {"doc", column.doc}});
  }
  for (const Group& group : groups_) {
    index["groups"].push_back({{"rows", group.rows}, {"parts", group.parts}});
  }
  return JsonText(index);
}

}  // namespace lyrefit
