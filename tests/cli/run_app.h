#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "../temp_folder.h"

namespace lyrefit {

struct AppResult {
  int exit_code = -1;  // -1: ended by a signal; 130 is what an interrupted run ends with itself
  std::string out;
  std::string err;
};

inline std::string FileText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Runs the lyrefit command with `arguments`, as the shell reads them, in a folder of its own; its
// standard input is the file `input`.
inline AppResult RunApp(const std::string& arguments, const std::string& input = "/dev/null") {
  const std::string base =
      (std::filesystem::path(::testing::TempDir()) / ("lyrefit-run-" + std::to_string(getpid())))
          .string();
  const std::string command = std::string("'") + LYREFIT_APP + "' " + arguments + " >'" + base +
                              ".out' 2>'" + base + ".err' <'" + input + "'";
  const int status = std::system(command.c_str());
  AppResult result;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 127;
  if (code < 126 || code == 130) result.exit_code = code;
  result.out = FileText(base + ".out");
  result.err = FileText(base + ".err");
  std::filesystem::remove(base + ".out");
  std::filesystem::remove(base + ".err");
  return result;
}

inline std::string DataFolder(const std::string& name) {
  return std::string(LYREFIT_DATA_DIR) + "/" + name;
}

// A made curve with so many points that its proof takes a while; returns its path.
inline std::string LongCurve(const TempFolder& folder) {
  const std::string path = folder.Path("long.csv");
  const AppResult made = RunApp(
      "simulate --set Iph=8 --set Is1=3e-10 --set n1=1.1 --set Rs=0.3 --set Rsh=300 --cells 60 "
      "--points 50000 --noise-A 0.008 --out '" +
      path + "'");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  return path;
}

inline void RemoveSeconds(nlohmann::json* value) {
  if (value->is_object()) value->erase("seconds");
  for (auto& child : *value) {
    if (child.is_structured()) RemoveSeconds(&child);
  }
}

// The JSON that a fit leaves on standard output; null if there is none.
inline nlohmann::json FitJson(const std::string& arguments) {
  const AppResult result = RunApp("fit " + arguments + " --json -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out, nullptr, false);
}

}  // namespace lyrefit
