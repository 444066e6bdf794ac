#include "plant/synthetic_table.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace made {
namespace {

std::vector<std::vector<std::string>> Records(const std::string& text) {
  std::vector<std::vector<std::string>> records;
  std::vector<std::string> record(1);
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      record.back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      record.emplace_back();
    } else if (!quoted && c == '\n') {
      records.push_back(record);
      record.assign(1, "");
    } else if (quoted || c != '\r') {
      record.back() += c;
    }
  }
  if (record.size() > 1) records.push_back(record);
  return records;
}

}  // namespace

std::string ReadRows(const std::string& path, std::vector<Row>* rows) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return "cannot read " + path;
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto records = Records(text);
  for (std::size_t r = 1; r < records.size(); ++r) {
    Row row;
    for (std::size_t c = 0; c < std::min(records[0].size(), records[r].size()); ++c) {
      row[records[0][c]] = records[r][c];
    }
    rows->push_back(row);
  }
  const bool named = !records.empty() && std::count(records[0].begin(), records[0].end(), "id") > 0;
  return named ? "" : path + " has no column id";
}

std::string At(const Row& row, const char* name) {
  const auto found = row.find(name);
  return found == row.end() ? "" : found->second;
}

std::set<std::string> Words(const std::string& text, const char* between) {
  std::set<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(between, at);
    if (begin == std::string::npos) break;
    at = std::min(text.find_first_of(between, begin), text.size());
    words.insert(text.substr(begin, at - begin));
  }
  return words;
}

}  // namespace made
