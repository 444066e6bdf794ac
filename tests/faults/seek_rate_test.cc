#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "faults/score.h"

namespace faults {
namespace {

constexpr int kCases = 4;
constexpr double kAlarms = 0.05;  // of data in which nothing is hidden

struct Place {
  Kind kind;
  const Injection* injection;
};

void PrintTo(const Place& place, std::ostream* out) {
  *out << place.injection->name << " in " << Name(place.kind);
}

std::vector<Place> Places() {
  std::vector<Place> places;
  for (const Kind kind : KindsCalled("all")) {
    for (const Injection& injection : Injections()) {
      if (Shows(injection, kind)) places.push_back({kind, &injection});
    }
  }
  return places;
}

std::string Told(const Answer& answer) {
  std::string text = answer.error;
  for (const Claim& claim : answer.claims) {
    text += " " + claim.id;
    for (const std::string& other : claim.equivalents) text += "|" + other;
    for (const Strength& strength : claim.strengths) {
      text += " " + strength.symbol + "=" + std::to_string(strength.value) + strength.unit;
    }
  }
  return text.empty() ? "nothing" : text;
}

// The error is at most 60 % of the truth, or 1.5 times the half width of the interval.
bool Sane(const Sized& size, double truth) {
  const double slack = std::max(0.6 * std::fabs(truth), 0.75 * (size.high - size.low));
  return std::fabs(size.value - truth) <= slack;
}

class Seek : public testing::TestWithParam<Place> {};

// At least three of four cases are detected and named. Reported sizes are near the truth.
TEST_P(Seek, FindsNamesAndSizesWhatIsHidden) {
  const auto [kind, injection] = GetParam();
  int found = 0, named = 0;
  for (int i = 0; i < kCases; ++i) {
    Request request;
    request.kind = kind;
    request.injections = {injection};
    request.seed = SeedOf(2024, i);
    request.misfit = 12 + 8.0 * i / (kCases - 1);
    const std::optional<Case> made = MakeCase(request);
    ASSERT_TRUE(made) << "no device for case " << i;
    const Answer answer = Ask(made->measurement, i, 0, 1);
    ASSERT_EQ(answer.error, "");
    const CaseScore score = ScoreCase(*made, answer);
    found += score.detected;
    if (score.named) {
      ++named;
    } else {
      std::cout << "case " << i << " said:" << Told(answer) << "\n";
    }
    if (const std::optional<Sized> size = SizeOf(made->causes[0], answer)) {
      EXPECT_TRUE(Sane(*size, made->causes[0].size.value))
          << "case " << i << " is " << made->causes[0].size.value << made->causes[0].size.unit
          << ", said:" << Told(answer);
    }
  }
  EXPECT_GE(found, kCases - 1);
  EXPECT_GE(named, kCases - 1);
}

INSTANTIATE_TEST_SUITE_P(Hidden, Seek, testing::ValuesIn(Places()), [](const auto& place) {
  return std::string(Name(place.param.kind)) + "_" + place.param.injection->name;
});

double AtLeast(int count, int cases, double rate) {  // binomial tail probability
  double term = std::pow(1 - rate, cases), below = 0;
  for (int k = 0; k < count; ++k) {
    below += term;
    term *= (cases - k) * rate / ((k + 1) * (1 - rate));
  }
  return 1 - below;
}

// At this rate, more alarms than these have a probability below 0.002.
TEST(Silence, IsKeptWhereNothingIsHidden) {
  int cases = 0, alarms = 0;
  for (const Kind kind : KindsCalled("all")) {
    for (int i = 0; i < 8; ++i) {
      const Case made = MakeNull(kind, static_cast<NoiseType>(i % (kNoiseTypes - 1)), 100 + i);
      const Answer answer = Ask(made.measurement, i, 0, 1, made.second_diode);
      ASSERT_EQ(answer.error, "");
      ++cases;
      if (Counted(made, answer).empty()) continue;
      ++alarms;
      std::cout << Name(kind) << " " << i << " with " << made.absorbed << ":" << Told(answer)
                << "\n";
    }
  }
  EXPECT_GT(AtLeast(alarms, cases, kAlarms), 0.002) << alarms << " alarms in " << cases;
}

// Coefficients that are not stated are estimated, so no claim may say that they are stated wrongly.
TEST(Silence, IsKeptWhereTheCoefficientsAreNotStated) {
  int cases = 0, alarms = 0;
  for (int i = 0; i < 16; ++i) {
    Case made = MakeNull(Kind::kConditions, static_cast<NoiseType>(i % (kNoiseTypes - 1)), 300 + i);
    made.measurement.bandgap_eV = made.measurement.isc_tempco_per_K = 0;
    const Answer answer = Ask(made.measurement, i, 0, 1, made.second_diode);
    ASSERT_EQ(answer.error, "");
    ++cases;
    if (Counted(made, answer).empty()) continue;
    ++alarms;
    std::cout << i << " with " << made.absorbed << ":" << Told(answer) << "\n";
  }
  EXPECT_GT(AtLeast(alarms, cases, kAlarms), 0.002) << alarms << " alarms in " << cases;
}

}  // namespace
}  // namespace faults
