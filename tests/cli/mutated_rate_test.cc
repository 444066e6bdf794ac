// Curves with defects of every known sort, as found in files of other people. Each verb gets a few
// files, or the number in the environment variable LYREFIT_MUTATIONS:
//   LYREFIT_MUTATIONS=300 build/tests/cli_rate_test --gtest_filter='Mutated*'
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "cli/run_app.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

struct Points {
  std::vector<double> v, i;
};

using Mutator = void (*)(std::mt19937* random, Points* points);

struct Mutation {
  const char* name;
  bool is_curve;  // a device could still give these readings
  Mutator apply;
};

std::size_t Index(std::mt19937* random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(*random);
}

void Keep(std::mt19937* random, std::size_t count, Points* p) {
  while (p->v.size() > count) {
    const std::size_t k = Index(random, p->v.size());
    p->v.erase(p->v.begin() + static_cast<std::ptrdiff_t>(k));
    p->i.erase(p->i.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

void AddNoise(std::mt19937* random, double part, std::vector<double>* values) {
  const double size = *std::max_element(values->begin(), values->end());
  std::normal_distribution<double> noise(0, part * size);
  for (double& value : *values) value += noise(*random);
}

void ConstantRun(std::mt19937* random, bool at_end, std::vector<double>* values) {
  // Near short circuit, a short run of equal values could come from a coarse meter. A run that
  // reaches into the knee could not.
  const std::size_t part = at_end ? values->size() / 3 : values->size() * 3 / 5;
  const std::size_t length = part + Index(random, values->size() / 4);
  const std::size_t begin = at_end ? values->size() - length : 0;
  const double level = (*values)[at_end ? begin : length];
  std::fill_n(values->begin() + static_cast<std::ptrdiff_t>(begin), length, level);
}

void Shuffle(std::mt19937* random, std::vector<double>* values) {
  std::shuffle(values->begin(), values->end(), *random);
}

const Mutation kMutations[] = {
    {"nothing", true, [](std::mt19937*, Points*) {}},
    {"voltage_noise", true, [](std::mt19937* r, Points* p) { AddNoise(r, 0.002, &p->v); }},
    {"much_noise", false, [](std::mt19937* r, Points* p) { AddNoise(r, 0.3, &p->v); }},
    {"current_noise", true, [](std::mt19937* r, Points* p) { AddNoise(r, 0.01, &p->i); }},
    {"order", true,
     [](std::mt19937* r, Points* p) {
       for (std::size_t k = p->v.size() - 1; k > 0; --k) {
         const std::size_t other = Index(r, k + 1);
         std::swap(p->v[k], p->v[other]);
         std::swap(p->i[k], p->i[other]);
       }
     }},
    {"shuffled", false, [](std::mt19937* r, Points* p) { Shuffle(r, &p->i); }},
    {"doubled", true,
     [](std::mt19937*, Points* p) {
       const Points once = *p;
       p->v.insert(p->v.end(), once.v.begin(), once.v.end());
       p->i.insert(p->i.end(), once.i.begin(), once.i.end());
     }},
    {"huge", false, [](std::mt19937* r, Points* p) { p->i[Index(r, p->i.size())] = 1e308; }},
    {"overflow", false, [](std::mt19937* r, Points* p) { p->i[Index(r, p->i.size())] = 9.91e37; }},
    {"huge_voltage", false,
     [](std::mt19937* r, Points* p) { p->v[Index(r, p->v.size())] = 1e308; }},
    {"reversed", true,
     [](std::mt19937*, Points* p) {
       std::reverse(p->v.begin(), p->v.end());
       std::reverse(p->i.begin(), p->i.end());
     }},
    {"few", false, [](std::mt19937* r, Points* p) { Keep(r, 2 + Index(r, 4), p); }},
    {"limit_at_end", false, [](std::mt19937* r, Points* p) { ConstantRun(r, true, &p->i); }},
    {"limit_at_begin", false, [](std::mt19937* r, Points* p) { ConstantRun(r, false, &p->i); }},
    {"constant", false,
     [](std::mt19937*, Points* p) { std::fill(p->i.begin(), p->i.end(), p->i.front()); }},
    {"zero", false, [](std::mt19937*, Points* p) { std::fill(p->i.begin(), p->i.end(), 0.0); }},
    {"tiny", false,
     [](std::mt19937*, Points* p) {
       for (double& i : p->i) i *= 1e-70;
     }},
    {"one_voltage", false,
     [](std::mt19937*, Points* p) { std::fill(p->v.begin(), p->v.end(), p->v.front()); }},
    {"exchanged", false, [](std::mt19937*, Points* p) { std::swap(p->v, p->i); }},
    {"milliampere", false,
     [](std::mt19937*, Points* p) {
       for (double& i : p->i) i *= 1e3;
     }},
    {"wrong_way", false,
     [](std::mt19937*, Points* p) {
       for (double& v : p->v) v = -v;
     }},
};

int HowMany(int otherwise) {
  const char* asked = std::getenv("LYREFIT_MUTATIONS");
  return asked != nullptr ? std::atoi(asked) : otherwise;
}

// Writes a mutant of one of the five measured benchmark curves, in turn. Returns the arguments for
// it: its path and --cells.
std::string WriteMutant(const TempFolder& folder, int number, const Mutation& mutation) {
  constexpr const char* kSources[] = {"rtc_france", "pwp201", "msx60", "stm6_40_36", "stp6_120_36"};
  const auto curve = ReadCurve(DataFolder(kSources[number % 5]));
  EXPECT_TRUE(curve.has_value());
  std::mt19937 random(static_cast<unsigned>(number));
  Points points{curve->voltage_V, curve->current_A};
  mutation.apply(&random, &points);
  const std::string path = folder.Path("mutant.csv");
  std::ofstream file(path);
  file.precision(12);
  file << "voltage,current\n";
  for (std::size_t k = 0; k < points.v.size(); ++k)
    file << points.v[k] << ',' << points.i[k] << '\n';
  return "'" + path + "' --cells " + std::to_string(curve->conditions.cells_in_series);
}

// The parser rejects bare NaN and numbers beyond the range of double, which are invalid JSON.
nlohmann::json Parsed(const std::string& text) {
  return nlohmann::json::parse(text, nullptr, false);
}

void GivesASoundAnswer(const std::string& verb, int count) {
  const TempFolder folder;
  for (int number = 0; number < count; ++number) {
    const Mutation& mutation = kMutations[number % std::size(kMutations)];
    SCOPED_TRACE(std::string(mutation.name) + ", number " + std::to_string(number));
    const std::string file = WriteMutant(folder, number, mutation);
    const AppResult result = RunApp(verb + " " + file + " --json -");
    ASSERT_THAT(result.exit_code, testing::AnyOf(0, 1, 2)) << result.err;
    if (result.exit_code == 1) {
      EXPECT_TRUE(result.out.empty());
      EXPECT_EQ(result.err.rfind("lyrefit: ", 0), 0U) << result.err;
      continue;
    }
    const nlohmann::json report = Parsed(result.out);
    ASSERT_TRUE(report.is_object()) << result.out.substr(0, 200);
    EXPECT_FALSE(mutation.is_curve && verb == "fit" && result.exit_code == 2);
    if (mutation.is_curve) continue;
    // A result for readings that no device gives carries a warning, a doubt or a verdict.
    const nlohmann::json none = nlohmann::json::array();
    const nlohmann::json verdict = report.value("verdict", nlohmann::json::object());
    EXPECT_TRUE(!report.value("warnings", none).empty() || !report.value("doubts", none).empty() ||
                verdict.value("found", false) || verdict.value("unexplained", false));
  }
}

TEST(MutatedCurve, GetsASoundFitOrAReason) { GivesASoundAnswer("fit", HowMany(42)); }

TEST(MutatedCurve, GetsASoundDiagnosisOrAReason) { GivesASoundAnswer("diagnose", HowMany(63) / 3); }

}  // namespace
}  // namespace lyrefit
