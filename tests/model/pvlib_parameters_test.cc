#include "lyrefit/model/pvlib_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "lyrefit/model/model_points.h"
#include "model/synthetic_translation.h"

namespace lyrefit {
namespace {

constexpr double kPvlibBoltzmann_J_K = 1.380649e-23;
constexpr double kPvlibCharge_C = 1.602176634e-19;

using PvlibModule = std::map<std::string, double>;

PvlibModule ToMap(const std::vector<NamedValue>& values) {
  PvlibModule module;
  for (const NamedValue& value : values) module[value.name] = value.value;
  return module;
}

struct PvlibArguments {
  double photocurrent, saturation_current, resistance_series, resistance_shunt, nNsVth;
  double d2mutau = 0;
  double NsVbi = std::numeric_limits<double>::infinity();
};

// pvlib's calcparams_desoto and, with Adjust, calcparams_cec.
PvlibArguments CalcparamsDesoto(const PvlibModule& m, double g, double temp_cell) {
  const double k_eV = kPvlibBoltzmann_J_K / kPvlibCharge_C;
  const double tref = m.at("temp_ref") + 273.15;
  const double t = temp_cell + 273.15;
  const double gap = m.at("EgRef") * (1 + m.at("dEgdT") * (t - tref));
  return {g / m.at("irrad_ref") * (m.at("I_L_ref") + m.at("alpha_sc") * (t - tref)),
          m.at("I_o_ref") * std::pow(t / tref, 3) *
              std::exp(m.at("EgRef") / (k_eV * tref) - gap / (k_eV * t)),
          m.at("R_s"), m.at("R_sh_ref") * m.at("irrad_ref") / g, m.at("a_ref") * t / tref};
}

PvlibArguments CalcparamsPvsyst(const PvlibModule& m, double g, double temp_cell) {
  const double tref = m.at("temp_ref") + 273.15;
  const double t = temp_cell + 273.15;
  const double gamma = m.at("gamma_ref") + m.at("mu_gamma") * (t - tref);
  const double fade = std::exp(-m.at("R_sh_exp"));
  const double base = std::max(0.0, (m.at("R_sh_ref") - m.at("R_sh_0") * fade) / (1.0 - fade));
  PvlibArguments p = {
      g / m.at("irrad_ref") * (m.at("I_L_ref") + m.at("alpha_sc") * (t - tref)),
      m.at("I_o_ref") * std::pow(t / tref, 3) *
          std::exp(kPvlibCharge_C * m.at("EgRef") / (kPvlibBoltzmann_J_K * gamma) *
                   (1 / tref - 1 / t)),
      m.at("R_s"),
      base + (m.at("R_sh_0") - base) * std::exp(-m.at("R_sh_exp") * g / m.at("irrad_ref")),
      gamma * kPvlibBoltzmann_J_K / kPvlibCharge_C * m.at("cells_in_series") * t};
  if (m.count("d2mutau") > 0) {
    p.d2mutau = m.at("d2mutau");
    p.NsVbi = m.at("NsVbi");
  }
  return p;
}

// The single-diode equation at voltage v by bisection on the diode voltage, which rises with the
// terminal voltage.
double Current(const PvlibArguments& p, double v) {
  const auto current = [&](double vd) {
    return p.photocurrent - p.saturation_current * std::expm1(vd / p.nNsVth) -
           vd / p.resistance_shunt - p.photocurrent * p.d2mutau / (p.NsVbi - vd);
  };
  double low = std::min(v, 0.0) - 1;
  double high = std::min(v + 1 + p.photocurrent * p.resistance_series, 0.99 * p.NsVbi);
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    (middle - current(middle) * p.resistance_series > v ? high : low) = middle;
  }
  return current(0.5 * (low + high));
}

template <class Calcparams>
void ExpectTheSameCurves(const Translation& translation, const std::vector<double>& shared,
                         const PvlibModule& module, const Calcparams& calcparams, double voc) {
  for (double g = 100; g <= 1100; g += 200) {
    for (double t = 0; t <= 70; t += 14) {
      const TranslatedDevice ours = TranslateTo(translation, shared, g, t + 273.15);
      const PvlibArguments theirs = calcparams(module, g, t);
      for (int k = 0; k <= 10; ++k) {
        const double v = 0.1 * k * voc;
        EXPECT_NEAR(SolveOperatingPoint(ours.device, ours.parameters.data(), v).current_A,
                    Current(theirs, v), 1e-9)
            << "G = " << g << ", T = " << t << ", V = " << v;
      }
    }
  }
}

TEST(PvlibParameters, OfDeSotoGiveTheSameCurvesInPvlibsEquations) {
  for (const ConstantSet constants : {ConstantSet::kCodata, ConstantSet::kPaper}) {
    TranslationSpec spec = DeSoto60();
    spec.constants = constants;
    const Translation translation = *MakeTranslation(spec);
    const auto values = PvlibParameters(translation, kSilicon);
    ASSERT_TRUE(values.has_value());
    const PvlibModule module = ToMap(*values);
    EXPECT_EQ(module.size(), 11U);
    EXPECT_EQ(module.at("cells_in_series"), 60);
    EXPECT_EQ(module.at("temp_ref"), 25);
    ExpectTheSameCurves(translation, kSilicon, module, CalcparamsDesoto, 37);
  }
}

TEST(PvlibParameters, OfPvsystGiveTheSameCurvesInPvlibsEquations) {
  for (const bool recombination : {false, true}) {
    for (const ShuntLaw shunt : {ShuntLaw::kExponential, ShuntLaw::kConstant}) {
      const Translation translation = *MakeTranslation(Pvsyst106(shunt, recombination));
      std::vector<double> shared = {1.2, 2e-10, 1.4, 5.1, 3100, 0.0006, 1.5, -0.001};
      if (shunt == ShuntLaw::kExponential) shared.insert(shared.end(), {9000, 5.5});
      if (recombination) shared.insert(shared.end(), {1.6, 0.9 * 106});
      const auto values = PvlibParameters(translation, shared);
      ASSERT_TRUE(values.has_value());
      const PvlibModule module = ToMap(*values);
      EXPECT_EQ(module.size(), recombination ? 15U : 13U);
      ExpectTheSameCurves(translation, shared, module, CalcparamsPvsyst, 82);
    }
  }
}

TEST(CecRow, GivesTheSameCurvesInPvlibsEquationsAndTheKeyPointsOfTheModel) {
  const Translation translation = *MakeTranslation(DeSoto60());
  const auto row = CecRow(translation, kSilicon, "A module", "Mono-c-Si");
  ASSERT_TRUE(row.has_value());
  EXPECT_EQ(row->name, "A module");
  EXPECT_EQ(row->technology, "Mono-c-Si");
  EXPECT_EQ(row->values.front().name, "N_s");
  PvlibModule module = ToMap(row->values);
  EXPECT_EQ(module.at("Adjust"), 0);
  module["EgRef"] = 1.121;
  module["dEgdT"] = -0.0002677;
  module["temp_ref"] = 25;
  module["irrad_ref"] = 1000;
  ExpectTheSameCurves(translation, kSilicon, module, CalcparamsDesoto, 37);
  const PvlibArguments at = CalcparamsDesoto(module, 1000, 25);
  EXPECT_NEAR(module.at("I_sc_ref"), Current(at, 0), 1e-9);
  EXPECT_NEAR(Current(at, module.at("V_oc_ref")), 0, 1e-9);
  EXPECT_NEAR(Current(at, module.at("V_mp_ref")), module.at("I_mp_ref"), 1e-9);
  const PvlibArguments hot = CalcparamsDesoto(module, 1000, 26);
  EXPECT_NEAR(Current(hot, module.at("V_oc_ref") + module.at("beta_oc")), 0, 2e-3);
  EXPECT_LT(module.at("beta_oc"), 0);
  EXPECT_GT(module.at("gamma_r"), -0.6);
  EXPECT_LT(module.at("gamma_r"), -0.3);
}

template <class Result>
std::string Complaint(const Result& result) {
  return result ? "" : result.error().message;
}

TEST(PvlibParameters, SayWhatPvlibCannotExpress) {
  TranslationSpec spec = DeSoto60();
  spec.model = Model::kDoubleDiode;
  std::vector<double> two = kSilicon;
  two.insert(two.end(), {1e-7, 2});
  EXPECT_NE(Complaint(PvlibParameters(*MakeTranslation(spec), two)).find("one diode"),
            std::string::npos);
  spec = DeSoto60();
  spec.shunt = ShuntLaw::kConstant;
  EXPECT_NE(Complaint(PvlibParameters(*MakeTranslation(spec), kSilicon)).find("shunt"),
            std::string::npos);
  spec.law = TranslationLaw::kPvsyst;
  spec.shunt = ShuntLaw::kInverse;
  EXPECT_NE(Complaint(PvlibParameters(*MakeTranslation(spec), kSilicon)).find("shunt"),
            std::string::npos);
  spec.shunt = ShuntLaw::kExponential;
  const Translation pvsyst = *MakeTranslation(spec);
  EXPECT_NE(Complaint(PvlibParameters(pvsyst, {9, 1e-9, 1, 0.3, 100, 0, 1.1, 0, 9e4, 5.5}))
                .find("R_sh_ref"),
            std::string::npos);
  EXPECT_NE(Complaint(PvlibParameters(pvsyst, {9, 1e-9})).find("found 2"), std::string::npos);
  EXPECT_NE(Complaint(CecRow(pvsyst, kSilicon, "", "")).find("desoto"), std::string::npos);
  std::vector<double> other_gap = kSilicon;
  other_gap[6] = 1.2;
  EXPECT_NE(Complaint(CecRow(*MakeTranslation(DeSoto60()), other_gap, "", "")).find("1.121"),
            std::string::npos);
}

}  // namespace
}  // namespace lyrefit
