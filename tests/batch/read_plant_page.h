#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Reader of the table in a plant page, written from the description in batch/plant_table.h only.
namespace plant_page {

// Each cell is null, a text or a number.
using Cells = std::vector<nlohmann::json>;

inline std::string FromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int have = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    have += 6;
    if (have >= 8) bytes += static_cast<char>(bits >> (have -= 8) & 0xff);
  }
  return bytes;
}

inline std::string Gunzipped(const std::string& packed) {
  z_stream stream = {};
  inflateInit2(&stream, 15 + 16);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string bytes;
  int state = Z_OK;
  while (state == Z_OK) {
    char block[65536];
    stream.next_out = reinterpret_cast<Bytef*>(block);
    stream.avail_out = sizeof block;
    state = inflate(&stream, Z_NO_FLUSH);
    bytes.append(block, sizeof block - stream.avail_out);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END ? bytes : std::string();
}

inline std::uint64_t Code(const std::string& bytes, std::size_t from, std::size_t n, int width,
                          std::size_t r) {
  std::uint64_t code = 0;
  for (int plane = 0; plane < width; ++plane) {
    code |= std::uint64_t{static_cast<unsigned char>(bytes.at(from + plane * n + r))}
            << (8 * plane);
  }
  return code;
}

inline nlohmann::json Number(const std::string& bytes, std::size_t n, std::size_t r) {
  if (bytes[0] == 0) {
    const std::uint64_t code = Code(bytes, 1, n, 8, r);
    double value = 0;
    std::memcpy(&value, &code, sizeof value);
    return value == value ? nlohmann::json(value) : nlohmann::json();
  }
  const std::uint64_t code = Code(bytes, 3, n, bytes[2], r);
  if (code == 0) return nullptr;
  const std::uint64_t z = code - 1;
  const double k = z % 2 == 0 ? static_cast<double>(z / 2) : -static_cast<double>((z + 1) / 2);
  return k / std::stod("1e" + std::to_string(static_cast<int>(bytes[1])));
}

inline Cells Part(const std::string& base64, std::size_t n) {
  const std::string bytes = Gunzipped(FromBase64(base64));
  Cells cells;
  if (bytes.at(0) == 2) return nlohmann::json::parse(bytes.substr(1)).get<Cells>();
  if (bytes[0] == 3) {
    const std::size_t length = Code(bytes, 2, 1, 4, 0);
    const nlohmann::json words = nlohmann::json::parse(bytes.substr(6, length));
    for (std::size_t r = 0; r < n; ++r) {
      cells.push_back(words.at(Code(bytes, 6 + length, n, bytes[1], r)));
    }
    return cells;
  }
  for (std::size_t r = 0; r < n; ++r) cells.push_back(Number(bytes, n, r));
  return cells;
}

// Text between `before` and `after`, searched from `*place`; moves `*place` to `after`.
inline std::string Between(const std::string& text, const std::string& before,
                           const std::string& after, std::size_t* place) {
  const std::size_t from = text.find(before, *place);
  if (from == std::string::npos) return "";
  const std::size_t start = from + before.size();
  const std::size_t end = text.find(after, start);
  *place = end;
  return text.substr(start, end - start);
}

// The index of the table, as JSON.
inline nlohmann::json Index(const std::string& html) {
  std::size_t place = 0;
  return nlohmann::json::parse(
      Between(html, "<script type=\"application/json\" id=\"table\">", "</script>", &place));
}

inline std::vector<Cells> Columns(const std::string& html) {
  const nlohmann::json index = Index(html);
  std::vector<Cells> columns(index.at("columns").size());
  std::size_t place = 0;
  for (const nlohmann::json& group : index.at("groups")) {
    const std::string rows =
        Between(html, "<script type=\"text/plain\" class=\"rows\">", "</script>", &place);
    std::size_t from = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::size_t size = group.at("parts").at(c);
      const Cells part = Part(rows.substr(from, size), group.at("rows"));
      columns[c].insert(columns[c].end(), part.begin(), part.end());
      from += size;
    }
  }
  return columns;
}

}  // namespace plant_page
