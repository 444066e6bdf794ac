#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "unpack.h"

// Reader of what a plant's page holds for its scripts.
namespace plant_page {

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
  return unpack::Gunzipped(unpack::FromBase64(
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
