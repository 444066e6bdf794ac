#pragma once

#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/procedure_steps.h"
#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// A simulated module of 60 cells that follows De Soto's law exactly, and its true values.
class SyntheticModule {
 public:
  SyntheticModule() {
    TranslationSpec spec;
    spec.cells_in_series = kCells;
    translation_ = *MakeTranslation(spec);
    shared_.assign(translation_.size(), 0);
    shared_[translation_.photocurrent] = 9.1;
    shared_[translation_.saturation_current] = 3e-10;
    shared_[translation_.n] = 1.02;
    shared_[translation_.resistance_series] = 0.25;
    shared_[translation_.resistance_shunt] = 400;
    shared_[translation_.alpha_sc] = kAlpha_A_K;
    shared_[translation_.bandgap] = 1.121;
    shared_[translation_.bandgap_slope] = kDeSotoBandgapSlope_per_K;
  }

  static constexpr int kCells = 60;
  static constexpr double kAlpha_A_K = 0.0046;

  TranslatedDevice At(double g, double t_C) const {
    return TranslateTo(translation_, shared_, g, t_C + kZeroCelsius_K);
  }

  KeyPoints Truth(double g, double t_C) const {
    const TranslatedDevice at = At(g, t_C);
    return ModelKeyPoints(at.device, at.parameters.data());
  }

  double Beta() const {
    return (Truth(1000, 30).open_circuit_voltage_V - Truth(1000, 20).open_circuit_voltage_V) / 10;
  }

  CurvePoints Readings(double g, double t_C, int count = 400) const {
    const TranslatedDevice at = At(g, t_C);
    const double voc = Truth(g, t_C).open_circuit_voltage_V;
    CurvePoints points;
    for (int k = 0; k < count; ++k) {
      points.voltage_V.push_back(voc * (-0.01 + 1.03 * k / (count - 1)));
      points.current_A.push_back(
          SolveOperatingPoint(at.device, at.parameters.data(), points.voltage_V.back()).current_A);
    }
    return points;
  }

  IvCurve Measured(double g, double t_C, int count = 100) const {
    IvCurve curve;
    const CurvePoints points = Readings(g, t_C, count);
    curve.name = "made";
    curve.conditions = {t_C + kZeroCelsius_K, g, kCells, 1};
    curve.voltage_V = points.voltage_V;
    curve.current_A = points.current_A;
    return curve;
  }

  SingleDiodeFit Diode(double g, double t_C) const {
    const TranslatedDevice at = At(g, t_C);
    const std::vector<double>& p = at.parameters;
    return {p[kIph], p[SaturationCurrentIndex(0)],
            p[IdealityIndex(0)] * at.device.module_thermal_voltage_V, p[kRs], p[kRsh]};
  }

  StatedCoefficients Coefficients() const {
    StatedCoefficients stated;
    stated.alpha_A_K = kAlpha_A_K;
    stated.beta_V_K = Beta();
    return stated;
  }

  TranslationInputs Bare(double g, double t_C) const {
    TranslationInputs inputs;
    inputs.irradiance_W_m2 = g;
    inputs.temperature_C = t_C;
    inputs.voltage_gain = inputs.current_gain = 1;
    return inputs;
  }

  // The readings with the true diode parameters, and with band gap and mu_gamma derived from them.
  PreparedCurve Curve(double g, double t_C, const TranslationTarget& target) const {
    PreparedCurve curve;
    curve.points = Readings(g, t_C);
    curve.cells_in_series = kCells;
    curve.diode = Diode(g, t_C);
    curve.target = target;
    TranslationInputs inputs = Bare(g, t_C);
    inputs.alpha_sc_A_K = kAlpha_A_K;
    inputs.beta_oc_V_K = Beta();
    inputs.EgRef_eV = 1.121;
    inputs.dEgdT_1_K = kDeSotoBandgapSlope_per_K;
    curve.bandgap = AnchorBandgap(*curve.diode, kCells, inputs);
    curve.mu_gamma = AnchorMuGamma(*curve.diode, kCells, inputs);
    return curve;
  }

  TranslationInputs Inputs(double g, double t_C) const {
    return SettleInputs(Coefficients(), "c-Si", Curve(g, t_C, {}), Bare(g, t_C)).values;
  }

 private:
  Translation translation_;
  std::vector<double> shared_;
};

}  // namespace lyrefit
