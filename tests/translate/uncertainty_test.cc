#include "lyrefit/translate/uncertainty.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "../error_of.h"
#include "lyrefit/base/random.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

UncertainInput Input(const char* name, double value, double u,
                     Distribution distribution = Distribution::kNormal) {
  UncertainInput input;
  input.name = name;
  input.title = name;
  input.value = value;
  input.standard_uncertainty = u;
  input.distribution = distribution;
  return input;
}

// Rectangular distribution between two limits.
UncertainInput Rectangle(const char* name, double low, double high) {
  return Input(name, 0.5 * (low + high), (high - low) / std::sqrt(12.0),
               Distribution::kRectangular);
}

UncertainModel Model(std::function<double(const std::vector<double>&)> f) {
  UncertainModel model;
  model.outputs = {{"y", "Y", "mg"}};
  model.evaluate = [f = std::move(f)](const std::vector<double>& x) {
    return std::vector<double>{f(x)};
  };
  return model;
}

UncertaintyOptions Options(double k, int draws, int digits = 2) {
  UncertaintyOptions options;
  options.coverage_factor = k;
  options.draws = draws;
  options.significant_digits = digits;
  options.threads = 2;
  return options;
}

constexpr double kAt95 = 1.959963984540054;

double Sum(const std::vector<double>& x) { return x[0] + x[1] + x[2] + x[3]; }

UncertaintyBudget Done(const UncertainModel& model, const UncertaintySources& sources,
                       const UncertaintyOptions& options) {
  const auto budget = Propagate(model, sources, options);
  EXPECT_TRUE(budget) << budget.error().ToString();
  return budget.value_or(UncertaintyBudget{});
}

TEST(Propagate, IsExactForLinearModels) {
  const UncertaintyBudget budget =
      Done(Model([](const std::vector<double>& x) { return 3 * x[0] - 4 * x[1] + 7; }),
           {{Input("a", 2, 1), Input("b", 5, 0.5)}}, Options(2, 0));
  EXPECT_DOUBLE_EQ(budget.outputs[0].value, -7);
  EXPECT_DOUBLE_EQ(budget.outputs[0].standard_uncertainty, std::sqrt(9.0 + 4.0));
  EXPECT_DOUBLE_EQ(budget.outputs[0].expanded_uncertainty, 2 * std::sqrt(13.0));
  EXPECT_DOUBLE_EQ(budget.lines[0].entries[0].sensitivity, 3);
  EXPECT_DOUBLE_EQ(budget.lines[1].entries[0].sensitivity, -4);
  EXPECT_DOUBLE_EQ(budget.lines[1].entries[0].contribution, -2);
  EXPECT_DOUBLE_EQ(budget.lines[0].entries[0].share, 9.0 / 13);
  EXPECT_EQ(budget.outputs[0].agreement, Agreement::kNotDone);
  EXPECT_NEAR(budget.coverage_probability, 0.9545, 5e-5);
}

// JCGM 101:2008, 9.2.2, 9.2.3 and 9.2.4, with the tolerances for interval ends that are printed
// there.
TEST(Propagate, GivesTheAdditiveExamplesOfJcgm101) {
  SKIP_IF_SANITIZED();
  const UncertainModel sum = Model(Sum);
  const UncertaintyBudget normal =
      Done(sum, {{Input("1", 0, 1), Input("2", 0, 1), Input("3", 0, 1), Input("4", 0, 1)}},
           Options(kAt95, 1000000));
  EXPECT_DOUBLE_EQ(normal.outputs[0].standard_uncertainty, 2);
  EXPECT_NEAR(normal.outputs[0].drawn.low, -3.92, 0.02);
  EXPECT_NEAR(normal.outputs[0].drawn.high, 3.92, 0.02);
  EXPECT_EQ(normal.outputs[0].agreement, Agreement::kAgree);

  const double r = std::sqrt(3.0);
  const UncertaintyBudget flat = Done(sum,
                                      {{Rectangle("1", -r, r), Rectangle("2", -r, r),
                                        Rectangle("3", -r, r), Rectangle("4", -r, r)}},
                                      Options(kAt95, 3000000));
  EXPECT_DOUBLE_EQ(flat.outputs[0].standard_uncertainty, 2);
  const double exact = 2 * r * (2 - std::pow(0.6, 0.25));  // printed: 3.88
  EXPECT_NEAR(exact, 3.88, 0.005);
  EXPECT_NEAR(flat.outputs[0].drawn.low, -exact, 4 * flat.outputs[0].drawn.low_error);
  EXPECT_NEAR(flat.outputs[0].drawn.high, exact, 4 * flat.outputs[0].drawn.high_error);
  EXPECT_EQ(flat.outputs[0].agreement, Agreement::kAgree) << "clause 9.2.3.4: two digits";
  const UncertaintyBudget three = Done(sum,
                                       {{Rectangle("1", -r, r), Rectangle("2", -r, r),
                                         Rectangle("3", -r, r), Rectangle("4", -r, r)}},
                                       Options(kAt95, 1000000, 3));
  EXPECT_EQ(three.outputs[0].agreement, Agreement::kDisagree) << "three digits";

  const UncertaintyBudget wide = Done(sum,
                                      {{Rectangle("1", -r, r), Rectangle("2", -r, r),
                                        Rectangle("3", -r, r), Rectangle("4", -10 * r, 10 * r)}},
                                      Options(kAt95, 1000000));
  EXPECT_NEAR(wide.outputs[0].standard_uncertainty, 10.1, 0.05);
  EXPECT_NEAR(wide.outputs[0].expanded_uncertainty, 19.9, 0.05);
  EXPECT_NEAR(wide.outputs[0].drawn.low, -17.0, 0.05);
  EXPECT_NEAR(wide.outputs[0].drawn.high, 17.0, 0.05);
  EXPECT_EQ(wide.outputs[0].agreement, Agreement::kDisagree);
  EXPECT_THAT(wide.outputs[0].sentence,
              HasSubstr("97 % of the variance has a rectangular distribution (4)"));
  EXPECT_DOUBLE_EQ(wide.outputs[0].low(), wide.outputs[0].drawn.low) << "the drawn one is quoted";
}

// JCGM 101:2008, 9.3, table 5: first-order 1.2340, 0.0539, [1.1285, 1.3395]; Monte Carlo 1.2341,
// 0.0754, [1.0834, 1.3825]; not validated.
TEST(Propagate, GivesTheMassCalibrationOfJcgm101) {
  const UncertainModel model = Model([](const std::vector<double>& x) {
    return (x[0] + x[1]) * (1 + (x[2] - 1.2) * (1 / x[3] - 1 / x[4])) - 100000;
  });
  const UncertaintyBudget budget =
      Done(model,
           {{Input("reference", 100000, 0.050), Input("small mass", 1.234, 0.020),
             Rectangle("air", 1.1, 1.3), Rectangle("weight", 7000, 9000),
             Rectangle("reference density", 7950, 8050)}},
           Options(kAt95, 1000000, 1));
  const UncertainOutput& mass = budget.outputs[0];
  EXPECT_NEAR(mass.value, 1.2340, 5e-5);
  EXPECT_NEAR(mass.standard_uncertainty, 0.0539, 5e-5);
  EXPECT_NEAR(mass.value - mass.expanded_uncertainty, 1.1285, 1e-4);
  EXPECT_NEAR(mass.value + mass.expanded_uncertainty, 1.3395, 1e-4);
  EXPECT_NEAR(mass.drawn.mean, 1.2341, 3e-4);
  EXPECT_NEAR(mass.drawn.standard_deviation, 0.0754, 2e-4);
  // The printed interval is the shortest one; its location is less certain than its length.
  const CoverageInterval shortest = ShortestInterval(mass.samples, 0.95);
  EXPECT_NEAR(shortest.low, 1.0834, 2e-3);
  EXPECT_NEAR(shortest.high, 1.3825, 2e-3);
  EXPECT_NEAR(shortest.high - shortest.low, 1.3825 - 1.0834, 5e-4);
  EXPECT_DOUBLE_EQ(mass.tolerance, 0.005);
  EXPECT_EQ(mass.agreement, Agreement::kDisagree);
  EXPECT_THAT(mass.sentence, HasSubstr("the air and the weight act as a product"));
}

// JCGM 101:2008, 9.4.2, table 6, in units of 1e-6: analytic values, shortest intervals.
TEST(Propagate, GivesTheComparisonLossOfJcgm101) {
  const UncertainModel model =
      Model([](const std::vector<double>& x) { return 1e6 * (x[0] * x[0] + x[1] * x[1]); });
  struct Row {
    double x1, y, u, low, high, linear_u, linear_low, linear_high;
  };
  for (const Row& row :
       {Row{0, 50, 50, 0, 150, 0, 0, 0}, Row{0.010, 150, 112, 0, 367, 100, -96, 296},
        Row{0.050, 2550, 502, 1590, 3543, 500, 1520, 3480}}) {
    const UncertaintyBudget budget = Done(
        model, {{Input("x1", row.x1, 0.005), Input("x2", 0, 0.005)}}, Options(kAt95, 1000000, 1));
    const UncertainOutput& loss = budget.outputs[0];
    EXPECT_NEAR(loss.value, row.y - 50, 1e-6);
    EXPECT_NEAR(loss.standard_uncertainty, row.linear_u, 0.5);
    EXPECT_NEAR(loss.value - loss.expanded_uncertainty, row.linear_low, 0.5);
    EXPECT_NEAR(loss.value + loss.expanded_uncertainty, row.linear_high, 0.5);
    EXPECT_NEAR(loss.drawn.mean, row.y, 2);
    EXPECT_NEAR(loss.drawn.standard_deviation, row.u, 1);
    const CoverageInterval shortest = ShortestInterval(loss.samples, 0.95);
    EXPECT_NEAR(shortest.low, row.low, row.x1 > 0.02 ? 12 : 1);
    EXPECT_NEAR(shortest.high, row.high, row.x1 > 0.02 ? 12 : 2);
    EXPECT_EQ(loss.agreement, Agreement::kDisagree);
    EXPECT_THAT(loss.sentence, HasSubstr("Y is not linear in the x1"));
  }
}

TEST(NumericalTolerance, IsHalfAUnitOfTheLastDigit) {
  // Examples of JCGM 101, 7.9.2.
  EXPECT_DOUBLE_EQ(NumericalTolerance(0.35, 2), 0.005);
  EXPECT_DOUBLE_EQ(NumericalTolerance(0.4, 1), 0.05);
  EXPECT_DOUBLE_EQ(NumericalTolerance(2, 1), 0.5);
  EXPECT_DOUBLE_EQ(NumericalTolerance(2, 1), 0.5);
  EXPECT_DOUBLE_EQ(NumericalTolerance(0.097, 1), 0.05) << "0.097 is 0.1 to one digit";
  EXPECT_EQ(NumericalTolerance(0, 1), 0);
}

TEST(Propagate, GivesTheSameBitsOnAnyNumberOfThreads) {
  const UncertainModel model =
      Model([](const std::vector<double>& x) { return std::exp(x[0]) * x[1]; });
  const UncertaintySources sources = {{Input("a", 0, 0.3), Rectangle("b", 1, 2)}};
  UncertaintyOptions options = Options(2, 5001);
  options.threads = 1;
  const UncertaintyBudget one = Done(model, sources, options);
  options.threads = 4;
  const UncertaintyBudget four = Done(model, sources, options);
  ASSERT_EQ(one.outputs[0].samples.size(), 5001u);
  EXPECT_EQ(std::memcmp(one.outputs[0].samples.data(), four.outputs[0].samples.data(),
                        5001 * sizeof(double)),
            0);
  EXPECT_EQ(one.outputs[0].drawn.mean, four.outputs[0].drawn.mean);
  options.seed = 1;
  EXPECT_NE(Done(model, sources, options).outputs[0].drawn.mean, one.outputs[0].drawn.mean);
}

// Noise of the readings correlates two results.
TEST(Propagate, KeepsTheCovarianceOfATerm) {
  UncertainModel model;
  model.outputs = {{"a", "A", ""}, {"b", "B", ""}, {"sum", "A + B", ""}};
  model.evaluate = [](const std::vector<double>&) { return std::vector<double>{1, 2, 3}; };
  OutputTerm noise;
  noise.name = "noise";
  noise.factors = FactorsOf({{4, -3, 1}, {-3, 9, 6}, {1, 6, 7}});
  const UncertaintyBudget budget = Done(model, {{}, {noise}}, Options(2, 200000));
  EXPECT_NEAR(budget.outputs[0].standard_uncertainty, 2, 1e-12);
  EXPECT_NEAR(budget.outputs[1].standard_uncertainty, 3, 1e-12);
  EXPECT_NEAR(budget.outputs[2].standard_uncertainty, std::sqrt(7.0), 1e-12);
  for (const UncertainOutput& output : budget.outputs) {
    EXPECT_NEAR(output.drawn.standard_deviation, output.standard_uncertainty,
                0.01 * output.standard_uncertainty);
  }
  EXPECT_EQ(noise.factors.size(), 2u) << "the third is the sum of the first two";
}

TEST(Propagate, SpreadsAChoiceOverItsAnswers) {
  UncertainModel model;
  model.outputs = {{"a", "A", "W"}, {"b", "B", "V"}};
  model.evaluate = [](const std::vector<double>&) { return std::vector<double>{10, 5}; };
  OutputChoice choice;
  choice.name = "cause";
  choice.title = "choice of the cause";
  choice.answers = {{12, 4}, {16, 2}};
  const UncertaintyBudget budget = Done(model, {{}, {}, {choice}}, Options(2, 200000));
  // 10 .. 16, middle 13: (16 - 10)^2 / 12 + 3^2.
  EXPECT_DOUBLE_EQ(budget.outputs[0].standard_uncertainty, std::sqrt(3.0 + 9.0));
  EXPECT_NEAR(budget.outputs[0].drawn.mean, 13, 0.02);
  EXPECT_GE(budget.outputs[0].samples.front(), 10);
  EXPECT_LE(budget.outputs[0].samples.back(), 16);
  EXPECT_GE(budget.outputs[1].samples.front(), 2);
  EXPECT_LE(budget.outputs[1].samples.back(), 5);
  EXPECT_EQ(budget.outputs[0].agreement, Agreement::kDisagree);
  EXPECT_THAT(budget.outputs[0].sentence, HasSubstr("choice of the cause"));
  EXPECT_DOUBLE_EQ(budget.lines[0].entries[0].share, 1);
}

TEST(Propagate, CountsDrawsWithoutAResult) {
  const UncertaintyBudget budget =
      Done(Model([](const std::vector<double>& x) { return x[0] > 0 ? x[0] : NAN; }),
           {{Input("a", 1, 0.5)}}, Options(2, 20000));
  EXPECT_NEAR(budget.outputs[0].failed_draws, 20000 * 0.02275, 100);
  ASSERT_EQ(budget.warnings.size(), 1u);
  EXPECT_THAT(budget.warnings[0], HasSubstr("draws have no Y"));
}

TEST(Propagate, SaysWhereDrawsAreTooFewToJudge) {
  const UncertaintyBudget budget = Done(Model([](const std::vector<double>& x) { return x[0]; }),
                                        {{Input("a", 0, 1)}}, Options(2, 200, 2));
  EXPECT_EQ(budget.outputs[0].agreement, Agreement::kUndecided);
  EXPECT_THAT(budget.outputs[0].sentence, HasSubstr("takes more draws"));
}

TEST(Propagate, RefusesWhatIsNoInput) {
  const UncertainModel model = Model([](const std::vector<double>& x) { return x[0]; });
  EXPECT_THAT(MessageOf(Propagate(model, {{Input("a", NAN, 1)}}, Options(2, 0))), HasSubstr("a: "));
  EXPECT_THAT(MessageOf(Propagate(model, {{Input("a", 1, -1)}}, Options(2, 0))), HasSubstr("a: "));
  EXPECT_THAT(MessageOf(Propagate(model, {{Input("a", 1, 1)}}, Options(9, 0))),
              HasSubstr("coverage-factor"));
  EXPECT_THAT(MessageOf(Propagate(Model([](const std::vector<double>&) { return NAN; }),
                                  {{Input("a", 1, 1)}}, Options(2, 0))),
              HasSubstr("none of the results"));
}

TEST(UncertainOutput, ProbabilityIsThatOfTheDrawsOrNormal) {
  const UncertainModel model = Model([](const std::vector<double>& x) { return x[0]; });
  const UncertaintyBudget drawn = Done(model, {{Input("a", 100, 2)}}, Options(2, 200000));
  const UncertaintyBudget linear = Done(model, {{Input("a", 100, 2)}}, Options(2, 0));
  EXPECT_NEAR(linear.outputs[0].ProbabilityBelow(98), 0.158655, 1e-6);
  EXPECT_NEAR(drawn.outputs[0].ProbabilityBelow(98), 0.158655, 0.003);
}

// The shortest interval with half of an exponential distribution begins at its lowest value.
TEST(ShortestInterval, LiesWhereTheSamplesAreDense) {
  std::vector<double> rising;
  for (int i = 0; i < 10000; ++i) rising.push_back(-std::log(1 - (i + 0.5) / 10000));
  const CoverageInterval half = ShortestInterval(rising, 0.5);
  EXPECT_NEAR(half.low, 0, 1e-3);
  EXPECT_NEAR(half.high, std::log(2.0), 1e-3);
}

}  // namespace
}  // namespace lyrefit
