// Joint fits of matrices of key points.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "error_of.h"
#include "lyrefit/base/random.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/family/refine_family.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct MatrixModule {
  TranslationLaw law;
  std::map<std::string, double> values;  // by pvlib's names
};

const MatrixModule kPvsystModule = {TranslationLaw::kPvsyst,
                                    {{"I_L_ref", 10},
                                     {"I_o_ref", 1e-11},
                                     {"gamma_ref", 1.0},
                                     {"mu_gamma", -1e-4},
                                     {"R_s", 0.2},
                                     {"R_sh_ref", 300},
                                     {"R_sh_0", 1500},
                                     {"R_sh_exp", 5.5},
                                     {"alpha_sc", 1e-3},
                                     {"EgRef", 1.121}}};

// A module by De Soto's law, or one that differs from it by `more`.
MatrixModule DeSotoModule(TranslationLaw law, const std::map<std::string, double>& more) {
  MatrixModule module{law, more};
  module.values.insert({{"I_L_ref", 6},
                        {"I_o_ref", 3e-10},
                        {"n", 1.1},
                        {"R_s", 0.25},
                        {"R_sh_ref", 250},
                        {"alpha_sc", 3e-3},
                        {"dEgdT", -0.0002677}});
  return module;
}

const MatrixModule kDeSotoModule = DeSotoModule(TranslationLaw::kDeSoto, {{"EgRef", 1.14}});
const MatrixModule kCecModule =
    DeSotoModule(TranslationLaw::kCec, {{"Adjust", 12}, {"EgRef", 1.121}});

using Conditions2 = std::vector<std::pair<double, double>>;  // W/m2, C
const Conditions2 kIec = {{100, 15},  {100, 25},  {200, 15},  {200, 25},  {400, 25},  {400, 50},
                          {600, 25},  {600, 50},  {600, 75},  {800, 25},  {800, 50},  {800, 75},
                          {1000, 25}, {1000, 50}, {1000, 75}, {1100, 25}, {1100, 50}, {1100, 75}};

Translation TranslationOf(const MatrixModule& module) {
  TranslationSpec spec;
  spec.law = module.law;
  spec.shunt = module.law == TranslationLaw::kPvsyst ? ShuntLaw::kExponential : ShuntLaw::kInverse;
  spec.cells_in_series = 60;
  return *MakeTranslation(spec);
}

std::vector<double> SharedOfModule(const MatrixModule& module) {
  const Translation at = TranslationOf(module);
  std::vector<double> shared;
  for (const ParameterInfo& info : at.parameters) shared.push_back(module.values.at(info.name));
  return shared;
}

// Errors that conditions share: K of a set temperature, part of a level of light.
struct SharedErrors {
  std::map<double, double> temperature_K, light;
};

// `noise`: in units of the default errors.
CurveSet MatrixFor(const MatrixModule& module, const Conditions2& conditions, double noise = 0,
                   SharedErrors shared_errors = {}) {
  const Translation at = TranslationOf(module);
  const std::vector<double> shared = SharedOfModule(module);
  const KeyPointErrors errors;
  RandomStream random(7, 0);
  CurveSet set;
  set.name = "matrix";
  for (const auto& [irradiance, temperature_C] : conditions) {
    const TranslatedDevice device =
        TranslateTo(at, shared, irradiance * (1 + shared_errors.light[irradiance]),
                    temperature_C + kZeroCelsius_K + shared_errors.temperature_K[temperature_C]);
    KeyPoints points = ModelKeyPoints(device.device, device.parameters.data());
    points.short_circuit_current_A *= 1 + noise * errors.short_circuit_current * random.Normal();
    points.open_circuit_voltage_V *= 1 + noise * errors.open_circuit_voltage * random.Normal();
    points.max_power_voltage_V *= 1 + noise * errors.max_power_voltage * random.Normal();
    points.max_power_W *= 1 + noise * errors.max_power * random.Normal();
    points.max_power_current_A = points.max_power_W / points.max_power_voltage_V;
    IvCurve curve;
    curve.name = fmt::format("{:g} W/m2, {:g} C", irradiance, temperature_C);
    curve.conditions.cells_in_series = 60;
    curve.conditions.irradiance_W_m2 = irradiance;
    curve.conditions.cell_temperature_K = temperature_C + kZeroCelsius_K;
    TakeKeyPoints(points, &curve);
    set.curves.push_back(std::move(curve));
  }
  return set;
}

FamilyOptions MatrixOptions(TranslationLaw law) {
  FamilyOptions options;
  options.law = law;
  options.random_baseline = false;
  return options;
}

class ExactMatrix : public ::testing::TestWithParam<MatrixModule> {};

TEST_P(ExactMatrix, GivesTheModuleBack) {
  const MatrixModule& module = GetParam();
  FamilyOptions options = MatrixOptions(module.law);
  // By the CEC's law alpha_sc is given, and Adjust is what remains.
  if (module.law == TranslationLaw::kCec) options.fixed = {{"alpha_sc", 3e-3}};
  const auto report = FitFamily(MatrixFor(module, kIec), options);
  ASSERT_TRUE(report) << report.error().ToString();
  const std::vector<double> truth = SharedOfModule(module);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(report->refined[i], truth[i], 1e-5 * std::fabs(truth[i]))
        << report->translation.parameters[i].name;
  }
  ASSERT_TRUE(report->key_points);
  EXPECT_LT(report->key_points->max_power_of_reference, 1e-8);
  EXPECT_LT(report->refined_key_points, 1e-5);
  EXPECT_GT(report->searched_key_points, 1);
  EXPECT_FALSE(report->equal_devices);
}

INSTANTIATE_TEST_SUITE_P(Matrices, ExactMatrix,
                         ::testing::Values(kPvsystModule, kDeSotoModule, kCecModule),
                         [](const auto& info) { return ToText(info.param.law); });

TEST(MatrixFit, ReportsErrorsOfEveryConditionAndOfThoseHeldOut) {
  const auto report =
      FitFamily(MatrixFor(kPvsystModule, kIec, 1), MatrixOptions(TranslationLaw::kPvsyst));
  ASSERT_TRUE(report) << report.error().ToString();
  const KeyPointSummary& summary = *report->key_points;
  EXPECT_EQ(summary.held_out, 18);
  EXPECT_GE(summary.covered, 15);
  EXPECT_GT(summary.scale, 0.5);
  EXPECT_LT(summary.scale, 1.5);
  double squares = 0;
  for (const FamilyCurve& curve : report->curves) {
    ASSERT_TRUE(curve.key_points);
    const KeyPointFit& fit = *curve.key_points;
    const double off =
        (fit.model.max_power_W - fit.measured.max_power_W) / summary.reference_power_W;
    squares += off * off;
    EXPECT_LT(fit.held_out_power_W.low_95, fit.held_out_power_W.value);
    // A condition that was not seen is missed by more than nothing and known no better.
    EXPECT_GT(fit.held_out_power_W.standard_error, 0.001 * fit.measured.max_power_W);
  }
  EXPECT_NEAR(summary.max_power_of_reference, std::sqrt(squares / 18), 1e-12);
  EXPECT_GE(summary.held_out_max_power_of_reference, summary.max_power_of_reference);
  // Pmp at 1000 W/m2 and 25 C as measured there.
  EXPECT_EQ(summary.reference_power_W, report->curves[12].key_points->measured.max_power_W);
}

const Estimate& EstimateOf(const FamilyReport& report, const std::string& name) {
  for (const Estimate& e : report.estimates) {
    if (e.info.name == name) return e;
  }
  ADD_FAILURE() << name;
  return report.estimates.front();
}

double WidthOf(const FamilyReport& report, const std::string& name) {
  const Estimate& e = EstimateOf(report, name);
  return e.high_95 - e.low_95;
}

const SharedErrors kChamber = {{{15, 0.9}, {25, -0.8}, {50, 1.0}, {75, -0.9}},
                               {{100, 0.008},
                                {200, -0.009},
                                {400, 0.007},
                                {600, -0.008},
                                {800, 0.009},
                                {1000, -0.007},
                                {1100, 0.008}}};

TEST(MatrixFit, FindsErrorsThatConditionsShareAndWidensTheIntervals) {
  const FamilyOptions options = MatrixOptions(TranslationLaw::kPvsyst);
  const auto clean = FitFamily(MatrixFor(kPvsystModule, kIec, 1), options);
  const auto common = FitFamily(MatrixFor(kPvsystModule, kIec, 1, kChamber), options);
  ASSERT_TRUE(clean && common);
  const KeyPointErrors &less = *clean->key_points->found, &more = *common->key_points->found;
  EXPECT_LT(less.temperature_K, 0.4);
  EXPECT_LT(less.irradiance, 0.004);
  EXPECT_GT(more.temperature_K, 0.5);
  EXPECT_GT(more.irradiance, 0.004);
  // Those of each kind stay what they are.
  EXPECT_NEAR(more.open_circuit_voltage, 0.003, 0.0015);
  for (const char* name : {"R_s", "mu_gamma", "gamma_ref"}) {
    EXPECT_GT(WidthOf(*common, name), 1.3 * WidthOf(*clean, name)) << name;
  }
  for (const char* name : {"I_L_ref", "gamma_ref", "R_s", "alpha_sc", "mu_gamma"}) {
    const Estimate& e = EstimateOf(*common, name);
    EXPECT_LE(e.low_95, kPvsystModule.values.at(name)) << name;
    EXPECT_GE(e.high_95, kPvsystModule.values.at(name)) << name;
  }
}

TEST(MatrixFit, TakesStatedErrorsOfConditions) {
  const CurveSet set = MatrixFor(kPvsystModule, kIec, 1);
  FamilyOptions options = MatrixOptions(TranslationLaw::kPvsyst);
  ASSERT_TRUE(ReadKeyPointErrors("temperature=0K,light=0%", &options.key_point_errors));
  const auto none = FitFamily(set, options);
  ASSERT_TRUE(ReadKeyPointErrors("temperature=1K,light=1%", &options.key_point_errors));
  const auto large = FitFamily(set, options);
  ASSERT_TRUE(none && large);
  EXPECT_EQ(none->refined, large->refined);
  EXPECT_EQ(none->key_points->found->temperature_K, 0);
  EXPECT_EQ(large->key_points->found->temperature_K, 1);
  EXPECT_GT(WidthOf(*large, "mu_gamma"), 1.5 * WidthOf(*none, "mu_gamma"));
  EXPECT_GT(WidthOf(*large, "R_s"), 1.5 * WidthOf(*none, "R_s"));
  const auto forecast = [](const FamilyReport& report) {
    return report.curves[9].key_points->held_out_power_W.standard_error;
  };
  EXPECT_GT(forecast(*large), 1.3 * forecast(*none));
}

// The set with one value changed by `factor`.
CurveSet WithWrong(CurveSet set, std::size_t curve, double KeyPoints::*point, double factor) {
  KeyPoints points = *set.curves[curve].key_points;
  points.*point *= factor;
  points.max_power_W = points.max_power_current_A * points.max_power_voltage_V;
  set.curves[curve].voltage_V.clear();
  set.curves[curve].current_A.clear();
  TakeKeyPoints(points, &set.curves[curve]);
  return set;
}

TEST(MatrixFit, NamesAWrongCellWithTheFitWithoutIt) {
  const FamilyOptions options = MatrixOptions(TranslationLaw::kPvsyst);
  const CurveSet set = MatrixFor(kPvsystModule, kIec, 1);
  const auto clean = FitFamily(set, options);
  ASSERT_TRUE(clean);
  EXPECT_FALSE(clean->without_outliers);
  const struct {
    double KeyPoints::*point;
    const char* name;
  } cells[] = {{&KeyPoints::max_power_current_A, "Imp"},
               {&KeyPoints::max_power_voltage_V, "Vmp"},
               {&KeyPoints::short_circuit_current_A, "Isc"},
               {&KeyPoints::open_circuit_voltage_V, "Voc"}};
  for (const auto& [point, name] : cells) {
    const auto report = FitFamily(WithWrong(set, 9, point, 1.1), options);
    ASSERT_TRUE(report);
    ASSERT_TRUE(report->without_outliers) << name;
    ASSERT_EQ(report->without_outliers->cells.size(), 1U) << name;
    const OutlierCell& cell = report->without_outliers->cells[0];
    EXPECT_EQ(cell.point, name);
    EXPECT_EQ(cell.id, "800 W/m2, 25 C");
    EXPECT_NEAR(cell.measured / cell.expected, 1.1, 0.02);
    EXPECT_TRUE(report->curves[9].outlier);
    EXPECT_FALSE(report->curves[8].outlier);
    EXPECT_THAT(report->warnings, ::testing::Contains(HasSubstr(std::string(name) +
                                                                " of 800 W/m2, 25 C looks wrong")));
    const int rs = report->translation.resistance_series;
    EXPECT_NEAR(report->without_outliers->shared[rs], clean->refined[rs], 0.02);
  }
}

TEST(MatrixFit, LeavesOutAConditionWhoseNameHasAComma) {
  FamilyOptions options = MatrixOptions(TranslationLaw::kPvsyst);
  ASSERT_TRUE(ReadLeaveOut("800 W/m2, 25 C,100 W/m2, 15 C", &options, {}));
  const auto report = FitFamily(MatrixFor(kPvsystModule, kIec, 1), options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(report->curves[9].role, CurveRole::kLeftOut);
  EXPECT_EQ(report->curves[0].role, CurveRole::kLeftOut);
  EXPECT_EQ(report->curves[1].role, CurveRole::kFitted);
}

TEST(MatrixFit, TakesTheSumOfTheGapsOfATandem) {
  CurveSet set = MatrixFor(kPvsystModule, kIec, 1);
  for (IvCurve& curve : set.curves) curve.notes.technology = "Amorphous silicon tandem junction";
  FamilyOptions options = MatrixOptions(TranslationLaw::kPvsyst);
  options.fixed = {{"EgRef", 3.4}};
  const auto report = FitFamily(set, options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(report->refined[report->translation.bandgap], 3.4);
  options.fixed = {{"EgRef", 5.1}};
  EXPECT_THAT(MessageOf(FitFamily(set, options)), HasSubstr("outside [0.3, 5]"));
}

// Warnings of a fit by `law` that ends with n = 0.96 and misses the key points by `scale` errors.
std::vector<std::string> WarningsOf(TranslationLaw law, double scale) {
  FamilyReport report;
  TranslationSpec spec;
  spec.law = law;
  report.translation = *MakeTranslation(spec);
  report.refined.assign(report.translation.parameters.size(), 1);
  report.refined[report.translation.n] = 0.96;
  report.estimates.resize(report.refined.size());
  report.key_points = KeyPointSummary();
  report.key_points->scale = scale;
  report.key_points->max_power = 0.05;
  return FamilyWarnings(report, MatrixOptions(law));
}

TEST(MatrixFit, ALawThatMissesIsNamedBeforeTheData) {
  EXPECT_THAT(WarningsOf(TranslationLaw::kCec, 5.4),
              ElementsAre(AllOf(
                  HasSubstr("The law cec does not describe these measurements"),
                  HasSubstr("by 5.4 times their errors"), HasSubstr("the law pvsyst or desoto"),
                  HasSubstr("other programs carry this error, and the ideality 0.96"))));
  EXPECT_THAT(WarningsOf(TranslationLaw::kDeSoto, 5.4),
              ElementsAre(HasSubstr("To try: the law pvsyst.")));
  // Where the law holds, such an n is a matter of the data.
  EXPECT_THAT(WarningsOf(TranslationLaw::kCec, 1.2),
              ElementsAre(HasSubstr("the number of cells or the temperatures")));
}

TEST(MatrixFit, TakesWhatIsStatedAndNoMore) {
  CurveSet set = MatrixFor(kDeSotoModule, kIec);
  for (std::size_t c = 0; c < set.curves.size(); c += 3) {
    KeyPoints points = *set.curves[c].key_points;
    points.max_power_current_A = points.max_power_voltage_V = points.max_power_W = kUnknown;
    set.curves[c].voltage_V.clear();
    set.curves[c].current_A.clear();
    TakeKeyPoints(points, &set.curves[c]);
  }
  const auto report = FitFamily(set, MatrixOptions(TranslationLaw::kDeSoto));
  ASSERT_TRUE(report) << report.error().ToString();
  const std::vector<double> truth = SharedOfModule(kDeSotoModule);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(report->refined[i], truth[i], 1e-5 * std::fabs(truth[i]));
  }
  EXPECT_EQ(report->key_points->held_out, 12);  // the others state no power
}

TEST(MatrixFit, ShowsTheDevicesThatTwoConditionsAllow) {
  const auto report = FitFamily(MatrixFor(kPvsystModule, {{1000, 25}, {800, 25}}, 1),
                                MatrixOptions(TranslationLaw::kPvsyst));
  ASSERT_TRUE(report) << report.error().ToString();
  ASSERT_TRUE(report->equal_devices);
  const EqualDevices& equal = *report->equal_devices;
  EXPECT_EQ(equal.along, "n1");
  ASSERT_GE(equal.devices.size(), 3U);
  for (const EqualDevice& device : equal.devices) {
    EXPECT_LE(device.rise, 1);
    EXPECT_NEAR(device.reference_power_W, report->reference.max_power_W,
                0.02 * report->reference.max_power_W);
  }
  const int n = report->translation.n;
  EXPECT_GT(equal.devices.back().shared[n], 1.2 * equal.devices.front().shared[n]);
}

TEST(MatrixFit, OfSweepsIsDoneWhereAsked) {
  SKIP_IF_SANITIZED();
  CurveSet set = MatrixFor(kDeSotoModule, kIec);
  const Translation at = TranslationOf(kDeSotoModule);
  for (IvCurve& curve : set.curves) {
    const TranslatedDevice device =
        TranslateTo(at, SharedOfModule(kDeSotoModule), curve.conditions.irradiance_W_m2,
                    curve.conditions.cell_temperature_K);
    const double voc = curve.key_points->open_circuit_voltage_V;
    curve.key_points.reset();
    curve.voltage_V.clear();
    for (int k = 0; k <= 400; ++k) curve.voltage_V.push_back(1.01 * voc * k / 400);
    curve.current_A = SolveCurrents(device.device, device.parameters.data(), curve.voltage_V);
  }
  FamilyOptions options = MatrixOptions(TranslationLaw::kDeSoto);
  options.individual_fits = false;
  EXPECT_FALSE(FitFamily(set, options)->key_points);
  options.residuals = FamilyResiduals::kKeyPoints;
  const auto report = FitFamily(set, options);
  ASSERT_TRUE(report) << report.error().ToString();
  ASSERT_TRUE(report->key_points);
  EXPECT_NEAR(report->refined[at.n], 1.1, 0.01);
}

TEST(MatrixFit, HasNoEffects) {
  FamilyOptions options = MatrixOptions(TranslationLaw::kDeSoto);
  options.residuals = FamilyResiduals::kKeyPoints;
  options.with = {{FindEffect("nonohmic_shunt"), {}}};
  EXPECT_THAT(MessageOf(FitFamily(MatrixFor(kDeSotoModule, kIec), options)),
              HasSubstr("residuals: with effects"));
}

TEST(KeyPointErrorsTest, AreReadByNameInPercent) {
  KeyPointErrors errors;
  ASSERT_TRUE(ReadKeyPointErrors("voc=0.5%,pmp=1", &errors));
  EXPECT_EQ(KeyPointErrorsText(errors), "isc=0.4%,voc=0.5%,vmp=0.6%,pmp=1%");
  EXPECT_TRUE(std::isnan(errors.temperature_K));
  ASSERT_TRUE(ReadKeyPointErrors("temperature=0.3K,light=0", &errors));
  EXPECT_EQ(KeyPointErrorsText(errors),
            "isc=0.4%,voc=0.5%,vmp=0.6%,pmp=1%,temperature=0.3K,light=0%");
  EXPECT_THAT(MessageOf(ReadKeyPointErrors("temperature=21", &errors)),
              HasSubstr("of at least 0 and at most 20 K"));
  EXPECT_THAT(MessageOf(ReadKeyPointErrors("imp=1%", &errors)), HasSubstr("expected isc, voc"));
  EXPECT_THAT(MessageOf(ReadKeyPointErrors("voc", &errors)), HasSubstr("expected isc, voc"));
  for (const char* bad : {"voc=0", "voc=-1%", "voc=51", "voc=x", "voc=nan", "voc="}) {
    EXPECT_THAT(MessageOf(ReadKeyPointErrors(bad, &errors)), HasSubstr("above 0 and at most 50 %"))
        << bad;
  }
}

}  // namespace
}  // namespace lyrefit
