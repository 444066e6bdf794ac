#include "studies/landscape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<LandscapeCase> Synthetic(const std::string& problem, int devices,
                                     std::uint64_t seed = 5) {
  auto cases = MakeLandscape(problem, devices, seed);
  EXPECT_TRUE(cases) << problem << ": " << cases.error().ToString();
  return cases ? *cases : std::vector<LandscapeCase>{};
}

std::vector<IvCurve> CurvesOf(const LandscapeCase& device) {
  return device.set ? device.set->curves : std::vector<IvCurve>{device.curve};
}

// The true values of the parameters in the order of the fit's law; every name of `truth` must occur
// in it.
std::vector<double> TruthIn(const std::vector<ParameterInfo>& infos, std::vector<double> usual,
                            const std::map<std::string, double>& truth) {
  std::size_t used = 0;
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const auto found = truth.find(infos[i].symbol);
    if (found == truth.end()) continue;
    usual[i] = found->second;
    ++used;
  }
  EXPECT_EQ(used, truth.size());
  return usual;
}

struct TruthFit {
  double rmse_A = 0;
  std::size_t points = 0;
  std::vector<std::string> outside;  // symbols of parameters whose truth is outside of the bounds
};

TruthFit OfCurve(const LandscapeCase& device) {
  FitOptions options;
  options.model = device.model;
  options.bounds = device.bounds;
  options.with = device.with;
  const auto prepared = PrepareFit(device.curve, options);
  EXPECT_TRUE(prepared) << prepared.error().ToString();
  if (!prepared) return {};
  const Device& fitted = prepared->device;
  std::vector<double> usual(fitted.size(), 0);
  if (fitted.effects) {
    const std::vector<double>& effects = fitted.effects->usual;
    std::copy(effects.begin(), effects.end(), usual.end() - effects.size());
  }
  std::vector<double> p = TruthIn(fitted.parameters, Reported(fitted, usual), device.truth);
  p = Internal(fitted, p);
  TruthFit result{std::sqrt(MeanSquare(prepared->problem, p)), device.curve.size(), {}};
  for (int i = 0; i < fitted.size(); ++i) {
    // The fit itself selects the reverse law of a weak cell, and with it the fixed parameters.
    const bool held = prepared->problem.lower[i] == prepared->problem.upper[i];
    if (held && fitted.parameters[i].symbol.rfind("weak_cell.", 0) == 0) continue;
    const double slack = 1e-9 * std::fabs(p[i]);
    const bool inside =
        p[i] >= prepared->problem.lower[i] - slack && p[i] <= prepared->problem.upper[i] + slack;
    if (!inside) result.outside.push_back(fitted.parameters[i].symbol);
  }
  return result;
}

TruthFit OfFamily(const LandscapeCase& device) {
  const auto family = MakeFamilyProblem(*device.set, device.family);
  EXPECT_TRUE(family) << family.error().ToString();
  if (!family) return {};
  const Translation& t = family->translation;
  std::vector<ParameterInfo> infos = t.parameters;
  for (const char* symbol : {"irradiance_offset_W_m2", "temperature_offset_K"}) {
    infos.push_back({symbol, symbol, "", "", ParameterKind::kPlain, 1});
  }
  const std::vector<double> none(infos.size(), 0);
  std::vector<double> shared = TruthIn(infos, none, device.truth);
  shared = InternalShared(t, shared);
  const JointProblem problem = JointProblemOn(*family, device.family, family->curves.fitted);
  const JointPoint point{shared, std::vector<JointLocal>(problem.curves.size(), {0, 0})};
  TruthFit result;
  result.rmse_A = FamilyRmse(problem, point).solved_current_A;
  for (const JointCurve& curve : problem.curves) result.points += curve.voltage_V.size();
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const double slack = 1e-9 * std::fabs(shared[i]);
    const bool inside =
        shared[i] >= problem.lower[i] - slack && shared[i] <= problem.upper[i] + slack;
    if (!inside) result.outside.push_back(infos[i].symbol);
  }
  return result;
}

class EveryProblem : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryProblem, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const auto first = Synthetic(GetParam(), 3), second = Synthetic(GetParam(), 3);
  const auto other = Synthetic(GetParam(), 3, 6);
  ASSERT_EQ(first.size(), 3U);
  for (int d = 0; d < 3; ++d) {
    const auto a = CurvesOf(first[d]), b = CurvesOf(second[d]);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t c = 0; c < a.size(); ++c) {
      EXPECT_EQ(a[c].voltage_V, b[c].voltage_V);
      EXPECT_EQ(a[c].current_A, b[c].current_A);
    }
    EXPECT_EQ(first[d].truth, second[d].truth);
    EXPECT_NE(first[d].truth, other[d].truth);
  }
  EXPECT_NE(first[0].truth, first[1].truth);
}

TEST_P(EveryProblem, BeginsAlikeWhateverTheCount) {
  const auto few = Synthetic(GetParam(), 2), many = Synthetic(GetParam(), 5);
  ASSERT_EQ(many.size(), 5U);
  for (std::size_t d = 0; d < few.size(); ++d) {
    EXPECT_EQ(few[d].truth, many[d].truth);
    EXPECT_EQ(CurvesOf(few[d])[0].current_A, CurvesOf(many[d])[0].current_A);
  }
}

// At the true parameters the fit's law leaves only noise, whose root mean square has a relative
// standard deviation of 1 / sqrt(2 N). This shows that the device was simulated by the law of the
// fit.
TEST_P(EveryProblem, LeavesTheNoiseAtTheTruth) {
  double squares = 0, points = 0;
  for (const LandscapeCase& device : Synthetic(GetParam(), 20)) {
    const TruthFit fit = device.set ? OfFamily(device) : OfCurve(device);
    ASSERT_GT(fit.points, 0U);
    const double ratio = fit.rmse_A / device.noise_A;
    const double count = static_cast<double>(fit.points);
    EXPECT_NEAR(ratio, 1, 4.5 / std::sqrt(2 * count)) << CurvesOf(device)[0].name;
    squares += ratio * ratio * count;
    points += count;
  }
  EXPECT_NEAR(std::sqrt(squares / points), 1, 3.5 / std::sqrt(2 * points));
}

TEST_P(EveryProblem, HasItsTruthWithinTheBoundsOfItsFit) {
  for (const LandscapeCase& device : Synthetic(GetParam(), 50)) {
    const TruthFit fit = device.set ? OfFamily(device) : OfCurve(device);
    EXPECT_THAT(fit.outside, ::testing::IsEmpty()) << CurvesOf(device)[0].name;
  }
}

// A passive device delivers current up to its open-circuit voltage; few readings lie beyond it.
TEST_P(EveryProblem, DeliversCurrentUpToOpenCircuit) {
  for (const LandscapeCase& device : Synthetic(GetParam(), 50)) {
    for (const IvCurve& curve : CurvesOf(device)) {
      const double largest = *std::max_element(curve.current_A.begin(), curve.current_A.end());
      const double noise = 5 * device.noise_A;
      for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
        EXPECT_GT(curve.voltage_V[k + 1], curve.voltage_V[k]) << curve.name;
        if (curve.voltage_V[k] < 0.98 * curve.voltage_V.back()) {
          EXPECT_GT(curve.current_A[k], -noise) << curve.name << " " << k;
        }
      }
      EXPECT_LT(curve.current_A.back(), noise) << curve.name;
      EXPECT_GT(curve.current_A.back(), -0.6 * largest) << curve.name;
    }
  }
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const LandscapeProblem& problem : LandscapeProblems()) names.push_back(problem.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Landscape, EveryProblem, ::testing::ValuesIn(Names()),
                         [](const auto& row) { return row.param; });

TEST(MakeLandscape, NamesWhatThereIsWhereANameIsUnknown) {
  const auto cases = MakeLandscape("strings_9", 2, 1);
  ASSERT_FALSE(cases);
  EXPECT_THAT(cases.error().ToString(),
              AllOf(HasSubstr("strings_9"), HasSubstr("strings_2"), HasSubstr("td_wide")));
}

TEST(MakeLandscape, RefusesCountsOutOfRange) {
  for (const int count : {0, -1, 10001}) {
    const auto cases = MakeLandscape("strings_2", count, 1);
    ASSERT_FALSE(cases) << count;
    EXPECT_THAT(cases.error().ToString(), HasSubstr(std::to_string(count)));
  }
}

TEST(MakeLandscape, DrawsGroupsOfUnlikeSizeFromWholeSubstrings) {
  std::set<int> substrings, groups;
  for (const LandscapeCase& device : Synthetic("strings_unlike", 100)) {
    const int count = *device.curve.notes.bypass_diodes;
    substrings.insert(count);
    std::set<int> sizes;
    int left = count, lights = 1;
    for (int k = 1; device.truth.count("substrings.w" + std::to_string(k)) > 0; ++k, ++lights) {
      const double size = count * device.truth.at("substrings.w" + std::to_string(k));
      EXPECT_NEAR(size, std::round(size), 1e-9);
      sizes.insert(static_cast<int>(std::lround(size)));
      left -= static_cast<int>(std::lround(size));
    }
    EXPECT_GE(left, 1);
    sizes.insert(left);
    EXPECT_GE(sizes.size(), 2U) << "all groups alike";
    groups.insert(lights);
  }
  EXPECT_EQ(substrings, (std::set<int>{3, 4, 5, 6}));
  EXPECT_EQ(groups, (std::set<int>{2, 3, 4}));
}

}  // namespace
}  // namespace lyrefit
