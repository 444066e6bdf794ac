#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../json_keys.h"
#include "temp_folder.h"

namespace lyrefit {

struct AppResult {
  int exit_code = -1;  // -1: ended by a signal; 130: a run that was interrupted and ended itself
  std::string out;
  std::string err;
};

// Runs the lyrefit command with `arguments`, in shell syntax, in a temporary folder. Its standard
// input is the file `input`.
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

// Writes a synthetic curve with so many points that its proof takes a while; returns the path.
inline std::string LongCurve(const TempFolder& folder) {
  const std::string path = folder.Path("long.csv");
  const AppResult made = RunApp(
      "simulate --set Iph=8 --set Is1=3e-10 --set n1=1.1 --set Rs=0.3 --set Rsh=300 --cells 60 "
      "--points 50000 --noise-A 0.008 --out '" +
      path + "'");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  return path;
}

inline const std::string kRtc = DataFolder("rtc_france");

struct Refusal {
  std::string arguments;
  std::string complaint;
};

// Expects exit code 1 and one sentence that holds the complaint for each refusal, and no file
// written.
inline void ExpectRefusals(const std::string& verb, const std::vector<Refusal>& refusals) {
  for (const Refusal& one : refusals) {
    const AppResult result = RunApp(verb + one.arguments);
    EXPECT_EQ(result.exit_code, 1) << one.arguments;
    EXPECT_EQ(result.out, "") << one.arguments;
    EXPECT_THAT(result.err, ::testing::StartsWith("lyrefit: ")) << one.arguments;
    EXPECT_THAT(result.err, ::testing::HasSubstr(one.complaint)) << one.arguments;
  }
}

// The JSON that a verb prints; null if there is none.
inline nlohmann::json AnswerJson(const std::string& arguments) {
  const AppResult result = RunApp(arguments + " --json -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out, nullptr, false);
}

inline nlohmann::json FitJson(const std::string& arguments) {
  return AnswerJson("fit " + arguments);
}

inline nlohmann::json CompareJson(const std::string& arguments) {
  return AnswerJson("compare " + arguments);
}

}  // namespace lyrefit
