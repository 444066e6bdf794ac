#include "lyrefit/model/plain_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "effects/synthetic_readings.h"

namespace lyrefit {
namespace {

// One effect, implemented three times: as templates, as plain functions with derivatives, and as
// plain functions with differences. It uses every field of StageInput.
Effect Named() {
  Effect e;
  e.id = "shunt_and_contact";
  e.parameters = {Parameter("k", "strength", "").Between(0, 1),
                  Parameter("m", "exponent", "").Between(1, 4).From(2),
                  Parameter("c", "contact", "").Between(0, 0.1)};
  return e;
}

Effect OfTemplates() {
  Effect e = Named();
  e.junction = [](const auto* p, const auto& cell, const auto& photocurrent, const auto& voltage) {
    const auto size = exp(p[1] * log(abs(voltage) * (1.0 / cell.reach) + 0.05));
    return -(voltage * size * p[0] * (0.5 + photocurrent) * (cell.thermal_voltage * 40.0));
  };
  e.series = [](const auto* p, const auto&, const auto& current) {
    return current * abs(current) * p[2];
  };
  return e;
}

double JunctionAt(const StageInput& in, int i) {
  const double size = std::pow(std::fabs(in.x[i]) / in.reach + 0.05, in.p[1]);
  return -in.x[i] * size * in.p[0] * (0.5 + in.photocurrent[i]) * in.thermal_voltage[i] * 40;
}

void Junction(const StageInput& in, const StageOutput& out) {
  for (int i = 0; i < in.count; ++i) {
    const double base = std::fabs(in.x[i]) / in.reach + 0.05;
    const double size = std::pow(base, in.p[1]);
    const double conditions = (0.5 + in.photocurrent[i]) * in.thermal_voltage[i] * 40;
    out.value[i] = JunctionAt(in, i);
    if (out.by_x != nullptr) {
      const double slope = in.p[1] * size / base * std::fabs(in.x[i]) / in.reach;
      out.by_x[i] = -(size + slope) * in.p[0] * conditions;
    }
    if (out.by_p == nullptr) continue;
    out.by_photocurrent[i] = -in.x[i] * size * in.p[0] * in.thermal_voltage[i] * 40;
    out.by_thermal_voltage[i] = -in.x[i] * size * in.p[0] * (0.5 + in.photocurrent[i]) * 40;
    out.by_p[i] = -in.x[i] * size * conditions;
    out.by_p[in.count + i] = -in.x[i] * size * std::log(base) * in.p[0] * conditions;
    out.by_p[2 * in.count + i] = 0;
  }
}

double SeriesAt(const StageInput& in, int i) { return in.x[i] * std::fabs(in.x[i]) * in.p[2]; }

void Series(const StageInput& in, const StageOutput& out) {
  for (int i = 0; i < in.count; ++i) {
    out.value[i] = SeriesAt(in, i);
    if (out.by_x != nullptr) out.by_x[i] = 2 * std::fabs(in.x[i]) * in.p[2];
    if (out.by_p == nullptr) continue;
    out.by_photocurrent[i] = out.by_thermal_voltage[i] = 0;
    out.by_p[i] = out.by_p[in.count + i] = 0;
    out.by_p[2 * in.count + i] = in.x[i] * std::fabs(in.x[i]);
  }
}

Effect OfPlainFunctions() {
  Effect e = Named();
  e.plain_junction = Junction;
  e.plain_series = Series;
  return e;
}

PlainValue Each(double (*at)(const StageInput&, int)) {
  return [at](const StageInput& in, double* value) {
    for (int i = 0; i < in.count; ++i) value[i] = at(in, i);
  };
}

Effect OfDifferences() {
  Effect e = Named();
  const std::vector<std::pair<double, double>> ranges = {{0, 1}, {1, 4}, {0, 0.1}};
  e.plain_junction = WithDifferences(Each(JunctionAt), ranges, true);
  e.plain_series = WithDifferences(Each(SeriesAt), ranges, false);
  return e;
}

struct Evaluated {
  bool found = false;
  std::vector<double> current;
  std::vector<double> jacobian;
};

Evaluated Evaluate(const Effect& effect, const Readings& readings, const std::vector<double>& own) {
  Law law;
  law.effects = {&effect};
  std::vector<double> p = ParametersOf({}, readings);
  p.insert(p.end(), own.begin(), own.end());
  Evaluated result;
  result.current.resize(readings.points.size());
  result.jacobian.resize(readings.points.size() * p.size());
  LawWorkspace workspace;
  result.found = EvaluateLaw(law, readings, p.data(), &workspace, result.current.data(),
                             result.jacobian.data());
  return result;
}

void ExpectRelative(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i], b[i], tolerance * (1 + std::fabs(b[i]))) << i;
  }
}

// Parameters inside their ranges and at the bounds, where differences become one-sided.
const std::vector<double> kPlaces[] = {{0.2, 2.5, 0.02}, {0, 1, 0}, {1, 4, 0.1}};

TEST(PlainStage, IsTheTemplateOfTheSameLaw) {
  const Effect templates = OfTemplates(), plain = OfPlainFunctions();
  for (const DataKind kind : kDataKinds) {
    const Readings readings = SyntheticReadings(kind, 60);
    for (const std::vector<double>& place : kPlaces) {
      const Evaluated expected = Evaluate(templates, readings, place);
      const Evaluated found = Evaluate(plain, readings, place);
      ASSERT_TRUE(expected.found && found.found) << NameOf(kind);
      ExpectRelative(found.current, expected.current, 1e-13);
      ExpectRelative(found.jacobian, expected.jacobian, 1e-11);
    }
  }
}

TEST(PlainStage, IsDifferentiatedWhereItSaysNoDerivatives) {
  const Effect templates = OfTemplates(), differences = OfDifferences();
  for (const DataKind kind : {DataKind::kReverse, DataKind::kFamily}) {
    const Readings readings = SyntheticReadings(kind, 60);
    for (const std::vector<double>& place : kPlaces) {
      const Evaluated expected = Evaluate(templates, readings, place);
      const Evaluated found = Evaluate(differences, readings, place);
      ASSERT_TRUE(expected.found && found.found) << NameOf(kind);
      ExpectRelative(found.current, expected.current, 1e-13);
      // At 0 V, |V| has a kink and differences are inexact.
      ExpectRelative(found.jacobian, expected.jacobian, 2e-9);
    }
  }
}

TEST(PlainStage, AsksNothingBeyondTheRangesOfItsParameters) {
  bool beyond = false;
  const PlainStage stage = WithDifferences(
      [&beyond](const StageInput& in, double* value) {
        beyond = beyond || in.p[0] < 0 || in.p[0] > 1;
        for (int i = 0; i < in.count; ++i) value[i] = std::sqrt(in.p[0]) * in.x[i];
      },
      {{0, 1}}, false);
  const double x = 0.5, conditions = 1;
  StageInput input{1, &x, &conditions, &conditions, nullptr, 1, 1, 1};
  double value = 0, by_x = 0, by_light = 1, by_warmth = 1, by_p = 0;
  const StageOutput output{&value, &by_x, &by_light, &by_warmth, &by_p};
  for (const double p : {1e-3, 0.4, 1 - 1e-7, 1.0}) {
    input.p = &p;
    stage(input, output);
    EXPECT_FALSE(beyond) << p;
    EXPECT_NEAR(by_x, std::sqrt(p), 1e-11);
    EXPECT_NEAR(by_p, 0.5 * x / std::sqrt(p), 1e-9);
    EXPECT_EQ(by_light, 0);
    EXPECT_EQ(by_warmth, 0);
  }
}

TEST(PlainStage, WithoutAValueEndsTheEvaluation) {
  Effect e = Named();
  e.plain_junction = [](const StageInput& in, const StageOutput& out) {
    Junction(in, out);
    for (int i = 0; i < in.count; ++i) out.value[i] = std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_FALSE(Evaluate(e, SyntheticReadings(DataKind::kForward, 1), kPlaces[0]).found);
}

}  // namespace
}  // namespace lyrefit
