// Verifies the stated probabilities by simulation. Strings of known power are measured with errors
// drawn from the stated uncertainties, translated to standard conditions and tested against the
// rating. In every bin the rate of wrong verdicts must equal the stated probability. The expanded
// interval must contain the true power in 95 +- 2 %.

#include "lyrefit/translate/field_test.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "../repeats.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/translate/field_inputs.h"
#include "lyrefit/translate/prepare.h"
#include "lyrefit/translate/translation_budget.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

constexpr double kAlpha_A_K = 0.005;

// Simulated string of 20 modules of 60 cells. A factor `strength` on its currents sets its power
// relative to the rating.
struct World {
  TranslationLaw law = TranslationLaw::kDeSoto;
  Procedure procedure = Procedure::kDeSoto;
  double translation_percent = 0;  // stated; negative: from the table
};

class Maker {
 public:
  explicit Maker(TranslationLaw law) {
    TranslationSpec spec;
    spec.law = law;
    spec.cells_in_series = 1200;
    if (law == TranslationLaw::kPvsyst) spec.shunt = ShuntLaw::kExponential;
    translation_ = *MakeTranslation(spec);
    good_.assign(translation_.size(), 0);
    good_[translation_.photocurrent] = 9;
    good_[translation_.saturation_current] = 1e-9;
    good_[translation_.n] = 1.05;
    good_[translation_.resistance_series] = 20 * 0.3;
    good_[translation_.resistance_shunt] = 20 * 400;
    good_[translation_.alpha_sc] = kAlpha_A_K;
    good_[translation_.bandgap] = 1.121;
    if (translation_.bandgap_slope >= 0) good_[translation_.bandgap_slope] = -2.677e-4;
    if (translation_.n_slope >= 0) good_[translation_.n_slope] = -0.0003;
    if (translation_.resistance_shunt_dark >= 0) {
      good_[translation_.resistance_shunt_dark] = 20 * 1600;
      good_[translation_.shunt_exponent] = 5.5;
    }
  }

  CurvePoints Sweep(double strength, double irradiance_W_m2, double temperature_C,
                    int points) const {
    std::vector<double> shared = good_;
    shared[translation_.photocurrent] *= strength;
    shared[translation_.saturation_current] *= strength;
    shared[translation_.alpha_sc] *= strength;
    const TranslatedDevice at =
        TranslateTo(translation_, shared, irradiance_W_m2, temperature_C + 273.15);
    CurvePoints sweep;
    double voltage = 0;
    const double step = 1000.0 / points;
    for (double current = 1; current > 0; voltage += step) {
      current = SolveOperatingPoint(at.device, at.parameters.data(), voltage).current_A;
      sweep.voltage_V.push_back(voltage);
      sweep.current_A.push_back(current);
    }
    return sweep;
  }

  KeyPoints Truth(double strength, double irradiance_W_m2, double temperature_C) const {
    const CurvePoints fine = Sweep(strength, irradiance_W_m2, temperature_C, 4000);
    return FindKeyPoints(fine.voltage_V, fine.current_A);
  }

 private:
  Translation translation_;
  std::vector<double> good_;
};

struct Judged {
  bool done = false;
  bool held = false;        // value +- U contains the true power
  bool held_drawn = false;  // the drawn interval contains it
  bool wrong = false;
  double stated = 0;
  Zone zone = Zone::kPass;
};

UncertaintyOptions Sure(const World& world) {
  UncertaintyOptions options;
  options.light_source = LightSource::kReferenceCell;
  options.temperature_source = TemperatureSource::kBackOfModule;
  options.draws = 1000;
  options.threads = 1;
  if (world.translation_percent >= 0) options.translation_percent = world.translation_percent;
  return options;
}

// Simulates a measurement with errors of sensors and instrument drawn from the stated
// uncertainties.
IvCurve Measure(const Maker& maker, double strength, double beta_V_K, RandomStream* random,
                TranslateOptions* how) {
  const double light = Between(random, 700, 1050), warm = Between(random, 30, 60);
  const CurvePoints truth = maker.Sweep(strength, light, warm, 100);
  IvCurve curve;
  curve.conditions.cells_in_series = 1200;
  curve.conditions.irradiance_W_m2 = light * (1 + 0.015 * random->Normal());
  curve.conditions.cell_temperature_K =
      273.15 + warm + 0.5 * random->Normal() - light / 1000 * (2.5 + 0.75 * random->Normal());
  const double gain_V = 1 + 0.005 * random->Normal(), gain_A = 1 + 0.005 * random->Normal();
  for (std::size_t i = 0; i < truth.voltage_V.size(); ++i) {
    curve.voltage_V.push_back(truth.voltage_V[i] / gain_V);
    curve.current_A.push_back(truth.current_A[i] / gain_A + 0.01 * random->Normal());
  }
  how->coefficients.alpha_A_K = kAlpha_A_K * (1 + 0.1 * random->Normal());
  how->coefficients.beta_V_K = beta_V_K * (1 + 0.025 * random->Normal());
  return curve;
}

Judged JudgeOne(const World& world, const Maker& maker, double beta_V_K, double rated_W,
                std::uint64_t string) {
  RandomStream random(20, string);
  // Uniform, far beyond both sides of the limit.
  const double strength = Between(&random, 0.87, 1.07);
  TranslateOptions how;
  how.procedures = {world.procedure};
  how.diagnosis.threads = 1;
  how.uncertainty.temperature_source = TemperatureSource::kBackOfModule;
  const IvCurve curve = Measure(maker, strength, beta_V_K, &random, &how);
  const auto made = Prepare(curve, how, Observer());
  Judged judged;
  if (!made) return judged;
  UncertaintyOptions uncertainty = Sure(world);
  uncertainty.seed = string;
  const auto budget =
      TranslationBudget(world.procedure, made->curve, made->inputs, {}, uncertainty);
  if (!budget) return judged;
  const UncertainOutput& power = budget->outputs[kMaxPowerOutput];
  FieldTestOptions rating;
  rating.rated_W = rated_W;
  rating.tolerance = {-3, 3, false};
  FieldMeasurement measurement;
  measurement.measured = FindKeyPoints(curve.voltage_V, curve.current_A);
  measurement.inputs = made->inputs.values;
  const auto test = JudgeFieldTest(power, measurement, rating, uncertainty);
  if (!test) return judged;
  const double true_W = maker.Truth(strength, 1000, 25).max_power_W;
  judged.done = true;
  judged.held = std::fabs(true_W - power.value) <= power.expanded_uncertainty;
  judged.held_drawn = true_W >= power.drawn.low && true_W <= power.drawn.high;
  judged.zone = test->zone;
  judged.stated = test->probability_wrong;
  judged.wrong = (test->probability_conforms > 0.5) != (true_W >= test->lowest_W);
  return judged;
}

struct Bin {
  double to;
  int strings = 0;
  int wrong = 0;
  double expected = 0;
  double variance = 0;
};

struct Rates {
  int done = 0;
  double held = 0;
  double held_drawn = 0;
  std::array<Bin, 5> bins = {{{0.005}, {0.05}, {0.15}, {0.3}, {1.01}}};
  std::array<int, 5> zones = {};
};

Rates Count(const World& world, int strings) {
  const Maker maker(world.law);
  const double rated_W = maker.Truth(1, 1000, 25).max_power_W;
  const double beta_V_K = (maker.Truth(1, 1000, 50).open_circuit_voltage_V -
                           maker.Truth(1, 1000, 25).open_circuit_voltage_V) /
                          25;
  std::vector<Judged> all(strings);
  ParallelFor(strings, 2, [&](int i) {
    all[i] = JudgeOne(world, maker, beta_V_K, rated_W, static_cast<std::uint64_t>(i));
  });
  Rates rates;
  for (const Judged& each : all) {
    if (!each.done) continue;
    ++rates.done;
    rates.held += each.held ? 1 : 0;
    rates.held_drawn += each.held_drawn ? 1 : 0;
    ++rates.zones[static_cast<int>(each.zone)];
    for (Bin& bin : rates.bins) {
      if (each.stated >= bin.to) continue;
      ++bin.strings;
      bin.wrong += each.wrong ? 1 : 0;
      bin.expected += each.stated;
      bin.variance += each.stated * (1 - each.stated);
      break;
    }
  }
  rates.held /= rates.done;
  rates.held_drawn /= rates.done;
  return rates;
}

void Print(const char* name, const Rates& rates) {
  std::printf("%s: %d strings, value +- U holds %.1f %%, drawn interval %.1f %%\n", name,
              rates.done, 100 * rates.held, 100 * rates.held_drawn);
  std::printf("  zones: %d pass, %d within, %d undecided, %d fail within, %d fail\n",
              rates.zones[0], rates.zones[1], rates.zones[2], rates.zones[3], rates.zones[4]);
  for (const Bin& bin : rates.bins) {
    std::printf("  stated below %5.1f %%: %5d strings, mean stated %6.2f %%, wrong %6.2f %%\n",
                100 * bin.to, bin.strings, 100 * bin.expected / std::max(1, bin.strings),
                100.0 * bin.wrong / std::max(1, bin.strings));
  }
}

// The device follows the law of the procedure, so the procedure has no error.
TEST(FieldTestRate, VerdictsAreWrongAsOftenAsStated) {
  const int strings = Repeats(2000, 500);
  const Rates rates = Count({TranslationLaw::kDeSoto, Procedure::kDeSoto, 0}, strings);
  Print("De Soto by De Soto", rates);
  EXPECT_EQ(rates.done, strings);
  EXPECT_NEAR(rates.held, 0.95, 0.02);
  EXPECT_NEAR(rates.held_drawn, 0.95, 0.02);
  for (const Bin& bin : rates.bins) {
    EXPECT_NEAR(bin.wrong, bin.expected, 3 * std::sqrt(bin.variance) + 1) << "below " << bin.to;
  }
  for (const int zone : rates.zones) EXPECT_GT(zone, strings / 30) << "every zone occurs";
}

// The device follows another law than the procedure. The stated uncertainty of the procedure covers
// the error, so verdicts are not wrong more often than stated.
TEST(FieldTestRate, AnotherLawIsWithinTheErrorOfTheProcedure) {
  for (const World& world : {World{TranslationLaw::kPvsyst, Procedure::kIec2, -1},
                             World{TranslationLaw::kPvsyst, Procedure::kDeSoto, -1},
                             World{TranslationLaw::kDeSoto, Procedure::kIec1, -1}}) {
    const int strings = Repeats(500, 150);
    const Rates rates = Count(world, strings);
    Print((ToText(world.law) + " by " + ToText(world.procedure)).c_str(), rates);
    EXPECT_GE(rates.done, strings * 0.99);
    EXPECT_GT(rates.held, 0.93);
    for (const Bin& bin : rates.bins) {
      EXPECT_LE(bin.wrong, bin.expected + 3 * std::sqrt(bin.variance) + 1) << "below " << bin.to;
    }
  }
}

}  // namespace
}  // namespace lyrefit
