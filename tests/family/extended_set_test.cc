#include "lyrefit/model/extended_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "family/synthetic_effects.h"

namespace lyrefit {
namespace {

struct Base {
  Model model;
  ShuntLaw shunt;
  double bandgap_slope;
};

// De Soto's law is implemented twice: for whole curves (Translation) and for single readings
// (ExtendedCurrents).
class ExtendedSetTest : public ::testing::TestWithParam<Base> {
 protected:
  void SetUp() override {
    TranslationSpec spec;
    spec.model = GetParam().model;
    spec.shunt = GetParam().shunt;
    spec.cells_in_series = 36;
    law_ = *MakeTranslation(spec);
    truth_ = SyntheticTruth(law_);
    truth_[law_.bandgap_slope] = GetParam().bandgap_slope;
    truth_.resize(law_.size());
    set_ = SyntheticSet(law_, truth_, kSixPlaces, 25, 0);
    set_.curves.push_back(DarkCurve(law_, truth_, 40, 25));
    set_.curves.push_back(SyntheticSet(law_, truth_, {{15, 30}}, 25, 0).curves[0]);
    extended_ = law_;
    const Expected<void> done = ExtendTranslation(set_, GetParam().bandgap_slope,
                                                  {UseOf("nonohmic_shunt")}, true, &extended_);
    ASSERT_TRUE(done) << done.error().ToString();
    shared_ = truth_;
    shared_.insert(shared_.end(), {0, 2.5});  // strength 0: no shunt effect
    p_ = ExtendedParameters(extended_, shared_.data());
  }

  Translation law_;
  std::vector<double> truth_;
  CurveSet set_;
  Translation extended_;
  std::vector<double> shared_;
  std::vector<double> p_;
};

TEST_P(ExtendedSetTest, IsTheTranslatedDeviceWhereItsEffectIsNotThere) {
  std::vector<double> all(set_.curves.size() * 25);
  ASSERT_TRUE(ExtendedCurrents(*extended_.extended, p_.data(), all.data(), nullptr));
  for (std::size_t c = 0; c < set_.curves.size(); ++c) {
    const Device device = OfCurve(*extended_.extended, static_cast<int>(c));
    std::vector<double> current_A(25);
    ASSERT_TRUE(ExtendedCurrents(device, p_.data(), current_A.data(), nullptr));
    for (int k = 0; k < 25; ++k) {
      EXPECT_NEAR(current_A[k], set_.curves[c].current_A[k], 1e-9) << c << " " << k;
      EXPECT_NEAR(current_A[k], all[25 * c + k], 1e-12);
    }
  }
}

TEST_P(ExtendedSetTest, HasTheSlopesOfCentralDifferences) {
  const int size = extended_.extended->size();
  p_[size - 2] = 0.01;  // strength of the shunt effect
  const std::size_t count = set_.curves.size() * 25;
  std::vector<double> current_A(count), slopes(count * size), up(count), down(count);
  const Device& device = *extended_.extended;
  ASSERT_TRUE(ExtendedCurrents(device, p_.data(), current_A.data(), slopes.data()));
  for (int i = 0; i < size; ++i) {
    const double step = 1e-5 * std::max(std::fabs(p_[i]), 1e-10);
    std::vector<double> above = p_, below = p_;
    above[i] += step;
    below[i] -= step;
    ASSERT_TRUE(ExtendedCurrents(device, above.data(), up.data(), nullptr));
    ASSERT_TRUE(ExtendedCurrents(device, below.data(), down.data(), nullptr));
    double largest = 0;
    for (std::size_t k = 0; k < count; ++k) {
      largest = std::max(largest, std::fabs(slopes[k * size + i]));
    }
    EXPECT_GT(largest, 0) << device.parameters[i].symbol;
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(slopes[k * size + i], (up[k] - down[k]) / (2 * step), 2e-5 * largest)
          << device.parameters[i].symbol << " " << k;
    }
  }
}

TEST_P(ExtendedSetTest, HasTheKeyPointsOfTheTranslatedDevice) {
  for (const SyntheticAt& at : {SyntheticAt{1000, 25}, SyntheticAt{500, 26}}) {
    const double kelvin = at.temperature_C + kZeroCelsius_K;
    const TranslatedDevice plain = TranslateTo(law_, truth_, at.irradiance_W_m2, kelvin);
    const KeyPoints expected = ModelKeyPoints(plain.device, plain.parameters.data());
    const KeyPoints points = ModelKeyPoints(
        UnderConditions(*extended_.extended, at.irradiance_W_m2 / 1000, kelvin), p_.data());
    EXPECT_NEAR(points.short_circuit_current_A, expected.short_circuit_current_A, 1e-6);
    EXPECT_NEAR(points.open_circuit_voltage_V, expected.open_circuit_voltage_V, 1e-4);
    EXPECT_NEAR(points.max_power_W, expected.max_power_W, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(Law, ExtendedSetTest,
                         ::testing::Values(Base{Model::kSingleDiode, ShuntLaw::kInverse,
                                                kDeSotoBandgapSlope_per_K},
                                           Base{Model::kSingleDiode, ShuntLaw::kConstant, 0},
                                           Base{Model::kDoubleDiode, ShuntLaw::kConstant, -4e-4}));

TEST(ExtendedSet, EffectsComeBackFromTheUnitsOfReports) {
  Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = SyntheticTruth(law);
  const CurveSet set = SyntheticSet(law, truth, kSixPlaces, 25, 0);
  const EffectUse use = UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}});
  ASSERT_TRUE(ExtendTranslation(set, 0, {use}, false, &law));
  std::vector<double> shared(truth.begin(), truth.end() - 2);
  const std::vector<double>& usual = law.extended->effects->usual;
  shared.insert(shared.end(), usual.begin(), usual.end());
  const std::vector<double> reported = ReportedShared(law, shared);
  EXPECT_NEAR(reported[law.size() - 2], 0.15, 1e-12);
  EXPECT_NEAR(reported[law.size() - 1], 2.5, 1e-12);
  for (int i = 0; i < law.size() - 2; ++i) EXPECT_EQ(reported[i], truth[i]);
}

}  // namespace
}  // namespace lyrefit
