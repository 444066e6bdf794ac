#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <string>

namespace lyrefit {

// Cases of functions, a line each in tests/golden/NAME.txt: what goes in, " => " and what comes out. A
// line "=== FUNCTION: REMARK" stands above those of a function. \n, \t, \r, \\ and \xNN are the
// characters that would break a line.
//
// To add a case, write what goes in and " =>": with LYREFIT_GOLDEN=write in the environment the test
// fills in what comes out. Read it before you commit it.
using CaseFunctions = std::map<std::string, std::function<std::string(const std::string&)>>;

inline std::string InOneLine(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const std::size_t at = std::string("\n\t\r\\").find(c);
    line += at < 4 ? std::string("\\") + "ntr\\"[at] : std::string(1, c);
  }
  return line;
}

inline std::string OutOfOneLine(const std::string& line) {
  std::string text;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] != '\\') {
      text += line[k];
    } else if (line[++k] == 'x') {
      text += static_cast<char>(std::stoi(line.substr(k + 1, 2), nullptr, 16));
      k += 2;
    } else {
      text += line[k] == 'n' ? '\n' : line[k] == 't' ? '\t' : line[k] == 'r' ? '\r' : line[k];
    }
  }
  return text;
}

inline void CheckCases(const std::string& name, const CaseFunctions& functions) {
  const std::string path = std::string(LYREFIT_DATA_DIR) + "/../tests/golden/" + name + ".txt";
  std::ifstream file(path);
  ASSERT_TRUE(file) << "no file " << path;
  const char* order = std::getenv("LYREFIT_GOLDEN");
  const bool write = order != nullptr && std::string(order) == "write";
  std::string text, function;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::size_t end = line.find(" =>");
    if (line.rfind("=== ", 0) == 0) function = line.substr(4, line.find(':') - 4);
    if (end != std::string::npos) {
      ASSERT_EQ(functions.count(function), 1U) << path << ":" << number << ", " << function;
      const std::string in = line.substr(0, end);
      const std::string out = InOneLine(functions.at(function)(OutOfOneLine(in)));
      const std::string now = in + (out.empty() ? " =>" : " => " + out);
      if (!write) {
        EXPECT_EQ(line, now) << path << ":" << number << ", " << function;
      }
      line = now;
    }
    text += line + "\n";
  }
  if (write) std::ofstream(path) << text;
}

}  // namespace lyrefit
