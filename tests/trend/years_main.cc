// Writes module-years with known damage: NAME.csv (sweeps), NAME_mpp.csv (operating points) and
// NAME.truth.json for each seed.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "trend/years_year.h"

namespace {

constexpr const char* kUsage =
    "lyrefit_years --out FOLDER [--years N] [--first-seed N] [--days N] [--minutes N]\n"
    "             [--points N] [--effects LIST | --random 1] [--perfect 1] [--clock-change 1]\n"
    "             [--field FOLDER]\n"
    "LIST: none, standard, or soiling[=%/day],snow,bypass[=DAY],series[=%/year],step[=OHM],\n"
    "      pid[=DAY],recombination[=%/year]\n";

struct Asked {
  years::Request request;
  std::string out, field, effects = "standard", error;
  int modules = 1;
};

bool Read(int argc, char** argv, Asked* asked) {
  years::Request& request = asked->request;
  const std::map<std::string, std::function<void(const char*)>> flags = {
      {"--out", [&](const char* text) { asked->out = text; }},
      {"--years", [&](const char* text) { asked->modules = std::atoi(text); }},
      {"--first-seed", [&](const char* text) { request.seed = std::strtoull(text, nullptr, 10); }},
      {"--days", [&](const char* text) { request.days = std::atoi(text); }},
      {"--minutes", [&](const char* text) { request.minutes = std::atof(text); }},
      {"--points", [&](const char* text) { request.points = std::atoi(text); }},
      {"--effects", [&](const char* text) { asked->effects = text; }},
      {"--random", [&](const char* text) { request.random = std::atoi(text) != 0; }},
      {"--perfect", [&](const char* text) { request.perfect = std::atoi(text) != 0; }},
      {"--clock-change", [&](const char* text) { request.clock_change = std::atoi(text) != 0; }},
      {"--field", [&](const char* text) { asked->field = text; }},
  };
  for (int i = 1; i + 1 < argc; i += 2) {
    const auto flag = flags.find(argv[i]);
    if (flag == flags.end()) return false;
    flag->second(argv[i + 1]);
  }
  return argc % 2 == 1 && !asked->out.empty() && request.days >= 2 && request.days <= 1096 &&
         request.minutes >= 1 && request.points >= 10;
}

bool Write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.flush();
  if (!file) std::fprintf(stderr, "lyrefit_years: cannot write %s\n", path.c_str());
  return static_cast<bool>(file);
}

bool WriteYear(const std::string& out, const years::Request& request,
               const years::Measured& measured) {
  const years::ModuleYear year = Simulate(request, measured);
  char name[40];
  std::snprintf(name, sizeof name, "year%04llu", static_cast<unsigned long long>(request.seed));
  const std::string path = (std::filesystem::path(out) / name).string();
  return Write(path + ".csv", SweepsCsv(year)) && Write(path + "_mpp.csv", OperatingCsv(year)) &&
         Write(path + ".truth.json", TruthJson(request, year));
}

}  // namespace

int main(int argc, char** argv) {
  Asked asked;
  if (!Read(argc, argv, &asked)) {
    std::fputs(kUsage, stderr);
    return 1;
  }
  asked.error = ReadEffects(asked.effects, &asked.request.effects);
  const years::Measured measured =
      asked.field.empty() ? years::BuiltIn() : years::FromFolder(asked.field, &asked.error);
  if (!asked.error.empty()) {
    std::fprintf(stderr, "lyrefit_years: %s\n", asked.error.c_str());
    return 1;
  }
  std::error_code failed;
  std::filesystem::create_directories(asked.out, failed);
  for (int i = 0; i < asked.modules; ++i, ++asked.request.seed) {
    if (!WriteYear(asked.out, asked.request, measured)) return 1;
  }
  return 0;
}
