#include "lyrefit/diagnose/law_coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/refine/model.h"
#include "lyrefit/model/device.h"

namespace lyrefit {
namespace {

constexpr int kIs = SaturationCurrentIndex(0), kN = IdealityIndex(0);
constexpr int kSecondIs = SaturationCurrentIndex(1);

// In the order of device.h. The photocurrent refers to 1000 W/m2: its bound admits curves down to
// 0.1 W/m2.
constexpr ParameterRange kBaseBounds[] = {{0, 1.2e4}, {-60, 40}, {0.2, 8}, {0, 3},
                                          {0, 50},    {0, 20},   {0.2, 8}};
constexpr ParameterRange kTempcoBounds = {-0.01, 0.01}, kBandgapBounds = {0.3, 2.5};

ParameterRange BoundsOf(const Law& law, int coordinate) {
  if (const EffectParameter* own = law.EffectParameterAt(coordinate)) {
    return {own->lower, own->upper};
  }
  if (law.free_bandgap && coordinate == law.BandgapAt()) return kBandgapBounds;
  if (law.free_tempco && coordinate == law.TempcoAt()) return kTempcoBounds;
  return kBaseBounds[coordinate];
}

}  // namespace

bool IsFixed(const Readings& readings, const Law& law, int parameter) {
  if (parameter == kIph && readings.traits.only_dark) return true;
  const bool second = law.model == Model::kDoubleDiode && parameter == IdealityIndex(1);
  return second || law.Searched(parameter);
}

LawCoordinates::LawCoordinates(const Law& law, const Readings& readings)
    : law_(law),
      readings_(readings),
      second_(law.model == Model::kDoubleDiode),
      ampere_(readings.scale.current_A),
      ohm_(readings.scale.resistance_ohm()),
      pivot_(readings.pivot_voltage / ThermalVoltage(readings.reference_temperature_K)),
      second_A_(readings.scale.saturation_2_unit * ampere_) {}

LeastSquaresProblem LawCoordinates::Problem() const {
  LeastSquaresProblem problem;
  problem.residuals = static_cast<int>(readings_.points.size());
  for (int k = 0; k < law_.size(); ++k) {
    const ParameterRange bounds = BoundsOf(law_, k);
    problem.lower.push_back(bounds.low);
    problem.upper.push_back(bounds.high);
    problem.fixed.push_back(IsFixed(readings_, law_, k) ? 1 : 0);
  }
  return problem;
}

std::vector<double> LawCoordinates::Of(const std::vector<double>& p) const {
  std::vector<double> theta = p;
  const double exponent = pivot_ / p[kN];
  theta[kIph] = p[kIph] / ampere_;
  theta[kIs] = std::log(p[kIs] / ampere_) + exponent + std::log1p(-std::exp(-exponent));
  theta[kRs] = p[kRs] / ohm_;
  theta[kRsh] = ohm_ / p[kRsh];
  if (second_) theta[kSecondIs] = p[kSecondIs] / second_A_;
  if (law_.free_tempco && p[kIph] > 0) theta[law_.TempcoAt()] /= p[kIph];
  return theta;
}

void LawCoordinates::SetParameters(const double* theta, double* p) const {
  const double exponent = pivot_ / theta[kN];
  p[kIph] = theta[kIph] * ampere_;
  // exp(theta) / (exp(x) - 1), without overflow where the cells are too few for the voltage.
  p[kIs] = ampere_ * std::exp(theta[kIs] - exponent) / -std::expm1(-exponent);
  p[kRs] = theta[kRs] * ohm_;
  p[kRsh] = ohm_ / theta[kRsh];
  if (second_) p[kSecondIs] = theta[kSecondIs] * second_A_;
  if (law_.free_tempco) p[law_.TempcoAt()] = theta[law_.TempcoAt()] * p[kIph];
}

std::vector<double> LawCoordinates::Parameters(const std::vector<double>& theta) const {
  std::vector<double> p = theta;
  SetParameters(theta.data(), p.data());
  return p;
}

// Calls `add(parameter, coordinate, derivative)` for the parameters of the base that are not their
// own coordinates. The derivative of a parameter by its own coordinate comes last.
template <class Add>
void LawCoordinates::ForSlopes(const double* theta, const double* p, Add add) const {
  const double exponent = pivot_ / p[kN];
  add(kIph, kIph, ampere_);
  add(kIs, kN, p[kIs] * exponent / (p[kN] * -std::expm1(-exponent)));
  add(kIs, kIs, p[kIs]);
  add(kRs, kRs, ohm_);
  add(kRsh, kRsh, -p[kRsh] * p[kRsh] / ohm_);
  if (second_) add(kSecondIs, kSecondIs, second_A_);
  if (!law_.free_tempco) return;
  const int at = law_.TempcoAt();
  add(at, kIph, theta[at] * ampere_);
  add(at, at, p[kIph]);
}

bool LawCoordinates::Evaluate(const double* theta, LawWorkspace* workspace, double* current,
                              double* jacobian, const std::vector<char>* fixed) const {
  std::array<double, kMostParameters> p;
  std::copy(theta, theta + law_.size(), p.begin());
  SetParameters(theta, p.data());
  // The derivative by an infinite Rsh would not show that by the conductance.
  p[kRsh] = std::min(p[kRsh], ohm_ / kPerfectConductance);
  if (!EvaluateLaw(law_, readings_, p.data(), workspace, current, jacobian, fixed)) return false;
  if (jacobian == nullptr) return true;
  const int size = law_.size();
  Eigen::Map<RowMatrix> rows(jacobian, static_cast<int>(readings_.points.size()), size);
  ForSlopes(theta, p.data(), [&](int parameter, int coordinate, double slope) {
    if (parameter == coordinate) {
      rows.col(parameter) *= slope;
    } else {
      rows.col(coordinate) += slope * rows.col(parameter);
    }
  });
  return true;
}

Eigen::MatrixXd LawCoordinates::Slopes(const std::vector<double>& theta) const {
  const std::vector<double> p = Parameters(theta);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Identity(law_.size(), law_.size());
  ForSlopes(theta.data(), p.data(), [&](int parameter, int coordinate, double slope) {
    slopes(parameter, coordinate) = slope;
  });
  return slopes;
}

namespace {

LawFit Better(LawFit a, LawFit b) {
  return b.usable && (!a.usable || b.sum < a.sum) ? std::move(b) : std::move(a);
}

// Refits with a constant shunt beside the catalogue's shunt that grows with light.
LawFit WithConstantShunt(const WeightedData& weighted, const LawFit& inverse) {
  LawFit best;
  for (const double law : {0.0, 1.0}) {  // linear and exponential
    Law both = inverse.law;
    both.shunt = ShuntLaw::kConstant;
    both.effects.push_back(FindEffect("photoshunt"));
    std::vector<double> start = inverse.p;
    start.push_back(0.95 * weighted.readings->scale.resistance_ohm() / start[kRsh]);
    start[kRsh] /= 0.05;
    start.push_back(law);
    best = Better(std::move(best), FitLaw(weighted, both, start));
  }
  return best;
}

Law ChooseShunt(const WeightedData& weighted, const Law& law) {
  // Gain, in units of the noise variance, below which two more parameters are not significant.
  constexpr double kNothing = 6;
  const LawFit constant = FitBase(weighted, law);
  Law proportional = law;
  proportional.shunt = ShuntLaw::kInverse;
  const LawFit inverse = FitLaw(weighted, proportional, constant.p);
  if (!constant.usable || !inverse.usable || inverse.sum >= constant.sum) return law;
  const LawFit both = WithConstantShunt(weighted, inverse);
  if (!both.usable) return proportional;
  const double variance = NoiseVariance(weighted, both);
  return inverse.sum - both.sum > kNothing * variance ? law : proportional;
}

}  // namespace

Law StartingLaw(const Readings& readings, Model model) {
  const DataTraits& traits = readings.traits;
  const bool temperatures = traits.temperature_levels > 1;
  Law law;
  law.model = model;
  law.bandgap_slope_per_K = readings.bandgap_slope_per_K.value_or(kDeSotoBandgapSlope_per_K);
  law.free_tempco = temperatures && !traits.tempco_known;
  law.free_bandgap = temperatures && !traits.bandgap_known;
  return law;
}

Law ChooseLaw(const WeightedData& weighted, const Law& law) {
  const DataTraits& traits = weighted.readings->traits;
  Law chosen = law;
  const bool slope_stated = weighted.readings->bandgap_slope_per_K.has_value();
  if (traits.temperature_levels > 1 && !law.free_bandgap && !slope_stated) {
    Law level = law;
    level.bandgap_slope_per_K = 0;
    const LawFit sloping = FitBase(weighted, law);
    const LawFit flat = FitBase(weighted, level);
    if (flat.usable && (!sloping.usable || flat.sum < sloping.sum)) chosen = level;
  }
  return traits.irradiance_levels > 1 ? ChooseShunt(weighted, chosen) : chosen;
}

std::string DescribeLaw(const Readings& readings, const Law& law) {
  const DataTraits& traits = readings.traits;
  std::string text = fmt::format(
      "{} parameters for all readings",
      law.model == Model::kDoubleDiode ? "two diodes (n2 = 2) and six" : "one diode and five");
  if (traits.curves > 1) {
    text += law.shunt == ShuntLaw::kInverse
                ? ", photocurrent and 1/Rsh in proportion to light"
                : ", photocurrent in proportion to light, Rsh that does not know the light";
  }
  if (traits.temperature_levels > 1) {
    text += law.bandgap_slope_per_K != 0
                ? fmt::format(", De Soto's saturation current with dEgdT {:.4g} 1/K",
                              law.bandgap_slope_per_K)
                : std::string(", De Soto's saturation current with a constant band gap");
  }
  if (law.free_tempco && law.free_bandgap) {
    text += "; the band gap and the temperature coefficient of Isc are not stated and estimated";
  } else if (law.free_tempco) {
    text += "; the temperature coefficient of Isc is not stated and estimated";
  } else if (law.free_bandgap) {
    text += "; the band gap is not stated and estimated";
  }
  return text;
}

}  // namespace lyrefit
