#include "lyrefit/diagnose/law_coordinates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "diagnose/synthetic_diagnosis.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kOverCharge = 8.617333262e-5;  // k / q, V/K

// A module of 60 cells by De Soto's law over irradiance and temperature, solved here by bisection,
// independently of the library.
struct Family {
  double alpha_per_K = 5e-4;
  double bandgap_eV = 1.121;
  double bandgap_slope = -2.677e-4;
  double saturation_2 = 0;  // saturation current of a second diode with n = 2, in ampere
  bool inverse_shunt = false;
  DeviceNotes stated;
};

struct Sky {
  double suns;
  double kelvin;
};

double Excess(const Family& family, const Sky& sky, double voltage, double current) {
  constexpr double kReference = 298.15, kIph = 9, kIs = 2e-10, kN = 1.1;
  const double warmer = sky.kelvin - kReference, ratio = sky.kelvin / kReference;
  const double gap = family.bandgap_eV * (1 + family.bandgap_slope * warmer);
  const double barrier =
      family.bandgap_eV / (kOverCharge * kReference) - gap / (kOverCharge * sky.kelvin);
  const double vt = 60 * kOverCharge * sky.kelvin, vj = voltage + 0.25 * current;
  const double shunt = (family.inverse_shunt ? sky.suns : 1) / 300;
  return sky.suns * kIph * (1 + family.alpha_per_K * warmer) -
         kIs * std::pow(ratio, 3) * std::exp(barrier) * std::expm1(vj / (kN * vt)) -
         family.saturation_2 * std::pow(ratio, 2.5) * std::exp(barrier / 2) *
             std::expm1(vj / (2 * vt)) -
         shunt * vj - current;
}

double Current(const Family& family, const Sky& sky, double voltage) {
  double low = -60, high = 12;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (Excess(family, sky, voltage, middle) > 0 ? low : high) = middle;
  }
  return low;
}

CurveSet Measured(const Family& family) {
  RandomStream random(3);
  std::vector<IvCurve> curves;
  for (const Sky sky : {Sky{1, 298.15},
                        {1, 323.15},
                        {1, 338.15},
                        {0.8, 318.15},
                        {0.6, 313.15},
                        {0.4, 303.15},
                        {0.2, 298.15},
                        {0.9, 333.15}}) {
    IvCurve curve;
    curve.name = "curve " + std::to_string(curves.size());
    curve.conditions.cells_in_series = 60;
    curve.conditions.irradiance_W_m2 = 1000 * sky.suns;
    curve.conditions.cell_temperature_K = sky.kelvin;
    curve.notes = family.stated;
    for (double v = 0; curve.current_A.empty() || curve.current_A.back() > -0.3; v += 1.1) {
      curve.voltage_V.push_back(v);
      const double i = Current(family, sky, v);
      curve.current_A.push_back(i + 0.003 * random.Normal() + 3e-4 * i * random.Normal());
    }
    curves.push_back(curve);
  }
  return SetOf(curves);
}

Diagnosis Diagnosed(const Family& family, Model base = Model::kSingleDiode) {
  DiagnoseOptions options = Quick(LaboratoryOptions());
  options.base = base;
  return DiagnoseOrFail(Measured(family), options);
}

DeviceNotes Stated(double bandgap_eV, double alpha_per_K) {
  DeviceNotes notes;
  notes.bandgap_eV = bandgap_eV;
  notes.isc_tempco_per_K = alpha_per_K;
  return notes;
}

TEST(ChooseBaseTest, CleanFamiliesOfEitherShuntAndGapAreClean) {
  for (const bool inverse : {false, true}) {
    for (const double slope : {0.0, -2.677e-4}) {
      Family family;
      family.inverse_shunt = inverse;
      family.bandgap_slope = slope;
      family.stated = Stated(1.121, 5e-4);
      const Diagnosis d = Diagnosed(family);
      EXPECT_THAT(Ids(d), IsEmpty()) << inverse << " " << slope << ": " << d.verdict.sentence;
      EXPECT_THAT(d.base_sentence, AllOf(HasSubstr(inverse ? "1/Rsh in proportion" : "Rsh that"),
                                         HasSubstr(slope == 0 ? "constant band gap" : "dEgdT")));
    }
  }
}

TEST(ChooseBaseTest, WhatIsNotStatedIsEstimatedAndNotAccused) {
  Family family;
  family.alpha_per_K = 2e-4;
  family.bandgap_eV = 1.3;
  family.inverse_shunt = true;
  const Diagnosis d = Diagnosed(family);
  EXPECT_THAT(Ids(d), IsEmpty()) << d.verdict.sentence;
  EXPECT_THAT(d.base_sentence, HasSubstr("not stated and estimated"));
  double alpha = 0, gap = 0;
  for (const ParameterShift& shift : d.gain.shifts) {
    if (shift.name == "alpha_sc") alpha = shift.after;
    if (shift.name == "EgRef") gap = shift.after;
  }
  EXPECT_NEAR(alpha, 2e-4 * 9, 2e-4);
  EXPECT_NEAR(gap, 1.3, 0.02);
}

TEST(ChooseBaseTest, TwoDiodesAreNoCauseBesideTwo) {
  Family family;
  family.saturation_2 = 2e-6;
  EXPECT_THAT(Ids(Diagnosed(family, Model::kDoubleDiode)), IsEmpty());
}

TEST(ChooseBaseTest, WhatIsStatedWronglyIsStillFound) {
  Family family;
  family.stated = Stated(1.121, 9e-4);
  EXPECT_THAT(Ids(Diagnosed(family)), ElementsAre("isc_tempco"));
  family.stated = Stated(1.15, 5e-4);
  EXPECT_THAT(Ids(Diagnosed(family)), ElementsAre("bandgap"));
}

TEST(ChooseBaseTest, ASlopeOfTheGapThatIsStatedIsBelieved) {
  Family family;
  family.stated = Stated(1.121, 5e-4);
  family.stated.bandgap_slope_per_K = family.bandgap_slope;
  EXPECT_THAT(Ids(Diagnosed(family)), IsEmpty());
  family.stated.bandgap_slope_per_K = 0;
  const Diagnosis d = Diagnosed(family);
  EXPECT_THAT(Ids(d), ElementsAre("bandgap"));
  EXPECT_THAT(d.base_sentence, HasSubstr("constant band gap"));
}

// A coefficient in A/K refers to 1000 W/m2 and 25 C, not to the brightest curve of the set.
TEST(ChooseBaseTest, ACoefficientInAmpereIsTakenAsItIs) {
  Family family;
  family.stated.bandgap_eV = 1.121;
  family.stated.isc_tempco_A_per_K = 5e-4 * 9;
  EXPECT_THAT(Ids(Diagnosed(family)), IsEmpty());
}

TEST(ChooseBaseTest, AShuntThatMerelyGrowsWithLightIsFound) {
  Family family;
  CurveSet set = Measured(family);
  for (IvCurve& curve : set.curves) {
    for (std::size_t k = 0; k < curve.size(); ++k) {
      curve.current_A[k] -= curve.conditions.irradiance_W_m2 / 1000 / 120 * curve.voltage_V[k];
    }
  }
  DiagnoseOptions options;
  options.held_out = false;
  const auto d = Diagnose(set, options);
  ASSERT_TRUE(d.has_value());
  ASSERT_TRUE(d->verdict.found);
  EXPECT_EQ(d->verdict.causes.front().id, "photoshunt") << d->verdict.sentence;
}

}  // namespace
}  // namespace lyrefit
