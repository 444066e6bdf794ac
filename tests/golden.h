#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "lyrefit/base/version.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {

inline std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The lines of a text, each of which must fit the terminal.
inline std::vector<std::string> NarrowLines(const std::string& text) {
  std::vector<std::string> lines = LinesOf(text);
  for (const std::string& line : lines) {
    EXPECT_LE(Columns(line), static_cast<std::size_t>(kTextWidth)) << line;
  }
  return lines;
}

// The texts of a report for records written by hand, one case after the other. The file
// tests/golden/NAME.txt holds them to the letter.
//
// With LYREFIT_GOLDEN=write in the environment the tests write the files instead of comparing: read
// the difference before you commit it.
class Golden {
 public:
  explicit Golden(std::string name) : name_(std::move(name)) {}

  // The whole text of a case.
  void Add(const std::string& title, const std::string& text) {
    Begin(title);
    const std::vector<std::string> lines = NarrowLines(text);
    for (const std::string& line : lines) Append(line);
    if (base_.empty()) base_ = lines;
  }

  // The whole text of a case that is not laid out for a terminal, such as a line of a brief report.
  void AddLong(const std::string& title, const std::string& text) {
    Begin(title);
    const std::vector<std::string> lines = LinesOf(text);
    for (const std::string& line : lines) Append(line);
    if (base_.empty()) base_ = lines;
  }

  // Of a text that resembles the first case: lines that are not in it ("+"), and those of it that
  // are missing ("-"), in their orders.
  void AddChanges(const std::string& title, const std::string& text) {
    NarrowLines(text);
    AddLongChanges(title, text);
  }

  // The same of texts that are not laid out for a terminal.
  void AddLongChanges(const std::string& title, const std::string& text) {
    Begin(title);
    const std::vector<std::string> lines = LinesOf(text);
    for (const std::string& line : Without(base_, lines)) Append("- " + line);
    for (const std::string& line : Without(lines, base_)) Append("+ " + line);
  }

  // Compares with the file, or writes it.
  void Check() const {
    const std::string path = std::string(LYREFIT_DATA_DIR) + "/../tests/golden/" + name_ + ".txt";
    const char* order = std::getenv("LYREFIT_GOLDEN");
    if (order != nullptr && std::string(order) == "write") {
      std::ofstream(path) << text_;
      return;
    }
    std::ifstream file(path);
    ASSERT_TRUE(file) << "no file " << path;
    std::stringstream content;
    content << file.rdbuf();
    const std::vector<std::string> is = LinesOf(text_), was = LinesOf(content.str());
    std::string title;
    for (std::size_t k = 0; k < is.size() && k < was.size(); ++k) {
      if (is[k].rfind("=== ", 0) == 0) title = is[k];
      ASSERT_EQ(is[k], was[k]) << path << ":" << k + 1 << ", " << title;
    }
    ASSERT_EQ(is.size(), was.size()) << path;
  }

 private:
  void Begin(const std::string& title) { text_ += "=== " + title + "\n"; }

  // Adds a line. A release does not change the files, so the version's number is not in them.
  void Append(std::string line) {
    const std::size_t at = line.find(Version());
    if (at != std::string::npos) line.replace(at, std::string(Version()).size(), "VERSION");
    text_ += line + "\n";
  }

  static std::vector<std::string> Without(const std::vector<std::string>& lines,
                                          const std::vector<std::string>& others) {
    std::map<std::string, int> there;
    for (const std::string& line : others) ++there[line];
    std::vector<std::string> rest;
    for (const std::string& line : lines) {
      if (there[line]-- <= 0) rest.push_back(line);
    }
    return rest;
  }

  std::string name_;
  std::string text_;
  std::vector<std::string> base_;
};

}  // namespace lyrefit
