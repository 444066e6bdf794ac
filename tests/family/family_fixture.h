#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "family/quick.h"
#include "family/synthetic_family.h"
#include "lyrefit/family/fit_family.h"

namespace lyrefit {

// A family of six curves by De Soto's law, and the options of its fit.
class FamilyFixture : public ::testing::Test {
 protected:
  FamilyFixture(int points, double noise_A) {
    set_ = SyntheticSet(law_, truth_, kSixPlaces, points, noise_A);
  }

  FamilyReport Fit() const {
    const Expected<FamilyReport> report = FitFamily(set_, options_);
    EXPECT_TRUE(report) << report.error().ToString();
    return report ? *report : FamilyReport{};
  }
  std::string Error() const {
    const Expected<FamilyReport> report = FitFamily(set_, options_);
    return report ? "" : report.error().ToString();
  }

  Translation law_ = SyntheticLaw(TranslationLaw::kDeSoto);
  std::vector<double> truth_ = SyntheticTruth(law_);
  CurveSet set_;
  FamilyOptions options_ = Quick();
};

}  // namespace lyrefit
