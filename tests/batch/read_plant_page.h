#pragma once

#include <zlib.h>

#include <nlohmann/json.hpp>
#include <string>

// Reader of what a plant's page holds for its scripts.
namespace plant_page {

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

// The rows, as the bytes of their CSV file.
inline std::string Rows(const std::string& html) {
  std::size_t place = 0;
  return Gunzipped(FromBase64(
      Between(html, "<script type=\"application/gzip\" id=\"rows\">", "</script>", &place)));
}

// What the page knows of the columns.
inline nlohmann::json Columns(const std::string& html) {
  std::size_t place = 0;
  return nlohmann::json::parse(
      Between(html, "<script type=\"application/json\" id=\"rows-columns\">", "</script>", &place));
}

// The JSON of a picture: "figure-1".
inline nlohmann::json Chart(const std::string& html, const std::string& figure) {
  std::size_t place = 0;
  return nlohmann::json::parse(Between(
      html, "<script type=\"application/json\" id=\"" + figure + "-chart\">", "</script>", &place));
}

}  // namespace plant_page
