#include "lyrefit/model/translation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dual.h"

namespace lyrefit {
namespace {

constexpr double kBoltzmann_J_K = 1.380649e-23;
constexpr double kCharge_C = 1.602176634e-19;
// pvlib rounds Boltzmann's constant to ten digits, which changes Io by 1e-10 at most.
constexpr double kBoltzmann_eV_K = kBoltzmann_J_K / kCharge_C;

// Return values of pvlib's calcparams_... functions.
struct FiveParameters {
  double photocurrent;
  double saturation_current;
  double resistance_series;
  double resistance_shunt;
  double nNsVth;
};

// pvlib's published equations (calcparams_desoto, calcparams_pvsyst), temperatures in C.
struct DeSotoModule {
  double alpha_sc, a_ref, I_L_ref, I_o_ref, R_sh_ref, R_s, EgRef, dEgdT;
};

FiveParameters CalcparamsDesoto(const DeSotoModule& m, double g, double temp_cell) {
  const double tref = 25 + 273.15;
  const double t = temp_cell + 273.15;
  const double gap = m.EgRef * (1 + m.dEgdT * (t - tref));
  return {g / 1000 * (m.I_L_ref + m.alpha_sc * (t - tref)),
          m.I_o_ref * std::pow(t / tref, 3) *
              std::exp(m.EgRef / (kBoltzmann_eV_K * tref) - gap / (kBoltzmann_eV_K * t)),
          m.R_s, m.R_sh_ref * (1000 / g), m.a_ref * (t / tref)};
}

// The CEC model is De Soto's with alpha_sc reduced by Adjust percent.
FiveParameters CalcparamsCec(DeSotoModule m, double adjust, double g, double temp_cell) {
  m.alpha_sc *= 1.0 - adjust / 100;
  m.EgRef = 1.121;
  m.dEgdT = -0.0002677;
  return CalcparamsDesoto(m, g, temp_cell);
}

struct PvsystModule {
  double alpha_sc, gamma_ref, mu_gamma, I_L_ref, I_o_ref, R_sh_ref, R_sh_0, R_s;
  int cells_in_series;
  double R_sh_exp, EgRef;
};

FiveParameters CalcparamsPvsyst(const PvsystModule& m, double g, double temp_cell) {
  const double tref = 25 + 273.15;
  const double t = temp_cell + 273.15;
  const double gamma = m.gamma_ref + m.mu_gamma * (temp_cell - 25);
  const double base = std::max(
      0.0, (m.R_sh_ref - m.R_sh_0 * std::exp(-m.R_sh_exp)) / (1.0 - std::exp(-m.R_sh_exp)));
  return {g / 1000 * (m.I_L_ref + m.alpha_sc * (t - tref)),
          m.I_o_ref * std::pow(t / tref, 3) *
              std::exp(kCharge_C * m.EgRef / (kBoltzmann_J_K * gamma) * (1 / tref - 1 / t)),
          m.R_s, base + (m.R_sh_0 - base) * std::exp(-m.R_sh_exp * g / 1000),
          gamma * kBoltzmann_J_K / kCharge_C * m.cells_in_series * t};
}

Translation Make(TranslationLaw law, ShuntLaw shunt, int cells, Model model = Model::kSingleDiode,
                 bool recombination = false) {
  TranslationSpec spec;
  spec.law = law;
  spec.shunt = shunt;
  spec.cells_in_series = cells;
  spec.model = model;
  spec.recombination = recombination;
  return *MakeTranslation(spec);
}

// Shared parameters from values by name; every parameter of the law must be named.
std::vector<double> Shared(const Translation& translation,
                           const std::vector<std::pair<std::string, double>>& values) {
  std::vector<double> shared(translation.size(), std::nan(""));
  for (const auto& [name, value] : values) shared[translation.Find(name).value()] = value;
  for (const double value : shared) EXPECT_FALSE(std::isnan(value));
  return shared;
}

void ExpectTheSame(const TranslatedDevice& ours, const FiveParameters& theirs) {
  const auto near = [](double found, double expected) {
    EXPECT_NEAR(found, expected, 1e-12 * std::fabs(expected));
  };
  const std::vector<double>& p = ours.parameters;
  near(p[kIph], theirs.photocurrent);
  near(p[SaturationCurrentIndex(0)], theirs.saturation_current);
  near(p[kRs], theirs.resistance_series);
  near(p[kRsh], theirs.resistance_shunt);
  near(p[IdealityIndex(0)] * ours.device.module_thermal_voltage_V, theirs.nNsVth);
}

template <class Check>
void OverConditions(const Check& check) {
  for (double g = 50; g <= 1200; g += 115) {
    for (double t = -10; t <= 80; t += 7.5) check(g, t);
  }
}

TEST(TranslateTo, IsPvlibsCalcparamsDesoto) {
  constexpr int kCells = 72;
  constexpr double kIdeality = 1.03;
  const double a_ref = kIdeality * kCells * kBoltzmann_J_K * 298.15 / kCharge_C;
  const DeSotoModule m = {0.00303, a_ref, 6.0, 5e-11, 412, 0.31, 1.14, -0.00031};
  const Translation translation = Make(TranslationLaw::kDeSoto, ShuntLaw::kInverse, kCells);
  const std::vector<double> shared = Shared(translation, {{"I_L_ref", 6.0},
                                                          {"I_o_ref", 5e-11},
                                                          {"n", kIdeality},
                                                          {"R_s", 0.31},
                                                          {"R_sh_ref", 412},
                                                          {"alpha_sc", 0.00303},
                                                          {"EgRef", 1.14},
                                                          {"dEgdT", -0.00031}});
  OverConditions([&](double g, double t) {
    ExpectTheSame(TranslateTo(translation, shared, g, t + 273.15), CalcparamsDesoto(m, g, t));
  });
}

TEST(TranslateTo, IsPvlibsCalcparamsCecWithTheAdjustedCoefficient) {
  constexpr int kCells = 60;
  constexpr double kIdeality = 0.98;
  constexpr double kAdjust = 8.7;
  const double a_ref = kIdeality * kCells * kBoltzmann_J_K * 298.15 / kCharge_C;
  const DeSotoModule m = {0.0046, a_ref, 8.9, 4e-10, 350, 0.27, 0, 0};
  const Translation translation = Make(TranslationLaw::kDeSoto, ShuntLaw::kInverse, kCells);
  const std::vector<double> shared =
      Shared(translation, {{"I_L_ref", 8.9},
                           {"I_o_ref", 4e-10},
                           {"n", kIdeality},
                           {"R_s", 0.27},
                           {"R_sh_ref", 350},
                           {"alpha_sc", 0.0046 * (1 - kAdjust / 100)},
                           {"EgRef", 1.121},
                           {"dEgdT", -0.0002677}});
  OverConditions([&](double g, double t) {
    ExpectTheSame(TranslateTo(translation, shared, g, t + 273.15), CalcparamsCec(m, kAdjust, g, t));
  });
}

const PvsystModule kThinFilm = {0.0007, 1.4, -0.0012, 1.2, 3e-10, 900, 5200, 3.0, 38, 5.5, 1.5};

std::vector<double> ThinFilm(const Translation& translation) {
  const PvsystModule& m = kThinFilm;
  std::vector<std::pair<std::string, double>> values = {
      {"I_L_ref", m.I_L_ref},   {"I_o_ref", m.I_o_ref},   {"gamma_ref", m.gamma_ref},
      {"R_s", m.R_s},           {"R_sh_ref", m.R_sh_ref}, {"alpha_sc", m.alpha_sc},
      {"EgRef", m.EgRef},       {"mu_gamma", m.mu_gamma}, {"R_sh_0", m.R_sh_0},
      {"R_sh_exp", m.R_sh_exp},
  };
  if (translation.n_2 >= 0) {
    values.emplace_back("I_o_ref_2", 2e-7);
    values.emplace_back("n_2", 2.1);
  }
  if (translation.recombination >= 0) {
    values.emplace_back("d2mutau", 1.3);
    values.emplace_back("NsVbi", 34.2);
  }
  return Shared(translation, values);
}

TEST(TranslateTo, IsPvlibsCalcparamsPvsyst) {
  for (const bool recombination : {false, true}) {
    const Translation translation = Make(TranslationLaw::kPvsyst, ShuntLaw::kExponential, 38,
                                         Model::kSingleDiode, recombination);
    const std::vector<double> shared = ThinFilm(translation);
    OverConditions([&](double g, double t) {
      const TranslatedDevice ours = TranslateTo(translation, shared, g, t + 273.15);
      ExpectTheSame(ours, CalcparamsPvsyst(kThinFilm, g, t));
      if (!recombination) return;
      EXPECT_EQ(ours.parameters[ours.device.Find("d2mutau").value()], 1.3);
      EXPECT_EQ(ours.parameters[ours.device.Find("NsVbi").value()], 34.2);
    });
  }
}

TEST(TranslateTo, GivesBackTheSharedValuesAtTheReference) {
  const Translation translation =
      Make(TranslationLaw::kPvsyst, ShuntLaw::kExponential, 38, Model::kDoubleDiode, true);
  const std::vector<double> shared = ThinFilm(translation);
  const TranslatedDevice at =
      TranslateTo(translation, shared, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  const int positions[] = {translation.photocurrent,
                           translation.saturation_current,
                           translation.n,
                           translation.resistance_series,
                           translation.resistance_shunt,
                           translation.saturation_current_2,
                           translation.n_2,
                           translation.recombination,
                           translation.built_in_voltage};
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(at.parameters[i], shared[positions[i]], 1e-13 * shared[positions[i]]) << i;
  }
  EXPECT_EQ(at.device.module_thermal_voltage_V, translation.device.module_thermal_voltage_V);
}

// Only n Ns Vt enters the equations. The reference device, with Vt at Tref, therefore takes n T /
// Tref.
TEST(Translate, HandsTheReferenceDeviceTheSameCurve) {
  const Translation translation =
      Make(TranslationLaw::kPvsyst, ShuntLaw::kExponential, 38, Model::kDoubleDiode, true);
  const std::vector<double> shared = ThinFilm(translation);
  std::vector<double> p(translation.device.size());
  Translate(translation, shared.data(), 420.0, 331.0, p.data());
  const TranslatedDevice at = TranslateTo(translation, shared, 420, 331);
  for (const double vd : {-2.0, 0.0, 15.0, 24.0}) {
    const double ours = JunctionCurrent(at.device, at.parameters.data(), vd);
    EXPECT_NEAR(JunctionCurrent(translation.device, p.data(), vd), ours, 1e-13 * std::fabs(ours));
  }
}

TEST(Translate, DualNumbersAgreeWithCentralDifferences) {
  constexpr int kMost = 16;
  using Unknowns = Dual<kMost>;
  for (const TranslationLaw law : {TranslationLaw::kDeSoto, TranslationLaw::kPvsyst}) {
    const bool pvsyst = law == TranslationLaw::kPvsyst;
    const Translation translation = Make(law, pvsyst ? ShuntLaw::kExponential : ShuntLaw::kInverse,
                                         38, Model::kDoubleDiode, pvsyst);
    std::vector<double> x =
        pvsyst ? ThinFilm(translation)
               : std::vector<double>{6, 5e-11, 1.1, 0.3, 410, 0.003, 1.12, -0.0003, 2e-6, 2.0};
    const int count = translation.size();
    x.push_back(640);    // irradiance
    x.push_back(322.4);  // temperature
    std::vector<Unknowns> jets(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) jets[i] = Unknowns(x[i], static_cast<int>(i));
    std::vector<Unknowns> device(translation.device.size());
    Translate(translation, jets.data(), jets[count], jets[count + 1], device.data());
    const auto at = [&](const std::vector<double>& y) {
      std::vector<double> d(translation.device.size());
      Translate(translation, y.data(), y[count], y[count + 1], d.data());
      return d;
    };
    for (std::size_t i = 0; i < x.size(); ++i) {
      std::vector<double> up = x, down = x;
      const double h = 1e-5 * std::fabs(x[i]);
      up[i] += h;
      down[i] -= h;
      const std::vector<double> high = at(up), low = at(down);
      for (int k = 0; k < translation.device.size(); ++k) {
        const double slope = (high[k] - low[k]) / (up[i] - down[i]);
        EXPECT_NEAR(device[k].v[static_cast<int>(i)] * x[i], slope * x[i],
                    1e-6 * (std::fabs(slope * x[i]) + 1e-3 * std::fabs(device[k].a)))
            << translation.device.parameters[k].symbol << " by input " << i;
      }
    }
  }
}

TEST(Translation, FindsParametersBySymbolAndByPvlibsName) {
  const Translation translation = Make(TranslationLaw::kPvsyst, ShuntLaw::kExponential, 38);
  EXPECT_EQ(translation.Find("gamma_ref"), translation.n);
  EXPECT_EQ(translation.Find("n1"), translation.n);
  EXPECT_EQ(translation.Find("Rsh0"), translation.resistance_shunt_dark);
  EXPECT_FALSE(translation.Find("dEgdT").has_value());
  EXPECT_EQ(translation.recombination, -1);
}

TEST(MakeTranslation, SaysWhatNoLawHas) {
  TranslationSpec spec;
  spec.model = Model::kTripleDiode;
  ASSERT_FALSE(MakeTranslation(spec).has_value());
  EXPECT_NE(MakeTranslation(spec).error().message.find("found td"), std::string::npos);
  spec.model = Model::kSingleDiode;
  spec.recombination = true;
  ASSERT_FALSE(MakeTranslation(spec).has_value());
  EXPECT_NE(MakeTranslation(spec).error().message.find("recombination"), std::string::npos);
  spec.recombination = false;
  spec.shunt = ShuntLaw::kExponential;
  ASSERT_FALSE(MakeTranslation(spec).has_value());
  EXPECT_NE(MakeTranslation(spec).error().message.find("shunt"), std::string::npos);
}

}  // namespace
}  // namespace lyrefit
