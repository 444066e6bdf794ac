// What `lyrefit inspect` says reads a file does read it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli/run_app.h"
#include "repeats.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// A suggested command with a value for each placeholder; the cells are those that the page
// suggests, a device is that of the first curve.
std::string FilledIn(std::string command, const nlohmann::json& found, const std::string& out) {
  std::string cells = "60";
  for (const nlohmann::json& way : found.at("missing")) {
    std::smatch some;
    const std::string what = way.at("what");
    if (std::regex_search(what, some, std::regex("some (\\d+)"))) cells = some[1];
  }
  const std::string name = found.at("curves").at(0).at("name");
  const std::pair<const char*, std::string> values[] = {
      {"--cells N", "--cells " + cells},
      {"--temperature-C T", "--temperature-C 25"},
      {"--irradiance-Wm2 G", "--irradiance-Wm2 1000"},
      {"--curve INDEX", "--curve 1"},
      {"--column NAME|N", "--column 1"},
      {"--column NAME", "--column '" + name + "'"},
      {"--out DIR", "--out '" + out + "'"},
      {"desoto|pvsyst", "pvsyst"}};
  for (const auto& [placeholder, value] : values) {
    const std::size_t at = command.find(placeholder);
    if (at != std::string::npos) {
      command.replace(at, std::string(placeholder).size(), value);
    }
  }
  return command;
}

TEST(InspectCliTest, EveryCommandThatItSuggestsReadsTheFile) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  int commands = 0;
  for (const auto& entry : fs::directory_iterator(DataFolder("formats"))) {
    if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
    const AppResult inspected = RunApp("inspect --json - '" + entry.path().string() + "'");
    const auto found = nlohmann::json::parse(inspected.out, nullptr, false);
    if (!found.is_object() || !found.contains("next")) continue;
    for (const std::string command : found.at("next")) {
      const std::string out = folder.Path("out" + std::to_string(++commands));
      const std::string filled = FilledIn(command, found, out);
      const AppResult result = RunApp(filled.substr(std::string("lyrefit ").size()));
      EXPECT_EQ(result.exit_code, 0) << filled << '\n' << result.err;
    }
  }
  EXPECT_GT(commands, 150);
}

}  // namespace
}  // namespace lyrefit
