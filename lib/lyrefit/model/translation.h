// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Law by which a device's parameters follow irradiance G and cell temperature T from their values
// at the reference (1000 W/m2, 25 C).
enum class TranslationLaw { kDeSoto, kPvsyst, kCec };

template <>
struct EnumTable<TranslationLaw> {
  static constexpr EnumText<TranslationLaw> kRows[] = {{TranslationLaw::kDeSoto, "desoto"},
                                                       {TranslationLaw::kPvsyst, "pvsyst"},
                                                       {TranslationLaw::kCec, "cec"}};
};

// Law of the shunt over irradiance.
enum class ShuntLaw {
  kInverse,      // Rsh = Rsh_ref Gref / G                                        De Soto
  kConstant,     // Rsh = Rsh_ref
  kExponential,  // R_sh_0 in the dark to R_sh_ref, exponential in G     PVsyst
};

template <>
struct EnumTable<ShuntLaw> {
  static constexpr EnumText<ShuntLaw> kRows[] = {{ShuntLaw::kInverse, "inverse"},
                                                 {ShuntLaw::kConstant, "constant"},
                                                 {ShuntLaw::kExponential, "exponential"}};
};

// Standard conditions, the reference of the shared parameters.
constexpr double kReferenceIrradiance_W_m2 = 1000;
constexpr double kReferenceTemperature_K = 298.15;
constexpr double kReferenceTemperature_C = 25;
constexpr double kDeSotoBandgapSlope_per_K = -2.677e-4;  // of silicon, De Soto 2006, eq. 10

// Selects a translation law for a device.
struct TranslationSpec {
  TranslationLaw law = TranslationLaw::kDeSoto;
  Model model = Model::kSingleDiode;  // sd or dd
  ShuntLaw shunt = ShuntLaw::kInverse;
  bool recombination = false;  // PVsyst's i-layer recombination: parameters d2mutau and NsVbi
  int cells_in_series = 1;
  ConstantSet constants = ConstantSet::kCodata;
};

// Shared parameters of a law, in the fixed order of `parameters` (symbols are the papers', names
// are pvlib's), and the device they translate to. See Translate for equations and sources.
struct Translation {
  TranslationSpec spec;  // law, model and device
  std::vector<ParameterInfo> parameters;
  // The device at the reference temperature. Its thermal voltage is that of the reference, and its
  // idealities must be n T / Tref. Thus one device serves every temperature.
  Device device;
  // Positions in the shared vector, -1 where the law has no such parameter.
  int photocurrent = -1;           // IL_ref, A
  int saturation_current = -1;     // Io_ref, A
  int n = -1;                      // n of De Soto, gamma_ref of PVsyst; per cell
  int resistance_series = -1;      // Rs, ohm
  int resistance_shunt = -1;       // Rsh_ref, ohm
  int alpha_sc = -1;               // A/K
  int adjust = -1;                 // Adjust, percent               CEC
  int bandgap = -1;                // EgRef, eV
  int bandgap_slope = -1;          // dEgdT, 1/K                    De Soto
  int n_slope = -1;                // mu_gamma, 1/K                 PVsyst
  int resistance_shunt_dark = -1;  // R_sh_0, ohm                   exponential shunt
  int shunt_exponent = -1;         // R_sh_exp                      exponential shunt
  int saturation_current_2 = -1;   // Io2_ref, A                    dd
  int n_2 = -1;                    // n2, per cell                  dd
  int recombination = -1;          // d2mutau, V                    recombination
  int built_in_voltage = -1;       // NsVbi, V                      recombination

  // With effects beside the diodes: the device behind all curves (extended_set.h), and the position
  // of each of its parameters in the shared vector. The effects' parameters are the last shared
  // ones, in internal units.
  std::optional<Device> extended;
  std::vector<int> shared_of;  // by position in `extended`
  int first_effect = -1;       // position in the shared vector

  // Number of shared parameters.
  int size() const { return static_cast<int>(parameters.size()); }
  // Position of a shared parameter.
  std::optional<int> Find(const std::string& symbol_or_name) const;
};

// Errors: model td; recombination or exponential shunt with De Soto's law, which has neither.
Expected<Translation> MakeTranslation(const TranslationSpec& spec);

// Shunt resistance in ohm at g = G / Gref.
template <class S>
S ShuntAt(const Translation& at, const S* shared, const S& g) {
  using std::exp;
  const S& reference = shared[at.resistance_shunt];
  if (at.spec.shunt == ShuntLaw::kConstant) return reference;
  if (at.spec.shunt == ShuntLaw::kInverse) return reference / g;
  const S fade = exp(-shared[at.shunt_exponent]);
  const S base = (reference - shared[at.resistance_shunt_dark] * fade) / (1.0 - fade);
  return base + (shared[at.resistance_shunt_dark] - base) * exp(-shared[at.shunt_exponent] * g);
}

// ln of the band gap factor of De Soto's saturation current from T0 (`from_K`) to T (`to_K`):
// Eg(T0) / (k T0) - Eg(T) / (k T), Eg = EgRef (1 + slope (T - Tref)). `k_eV`: k / q in eV/K.
template <class S>
S DeSotoBarrier(const S& gap, const S& slope, double from_K, const S& to_K, double k_eV) {
  const S from = gap * (1.0 + slope * (from_K - kReferenceTemperature_K));
  return from / (k_eV * from_K) -
         gap * (1.0 + slope * (to_K - kReferenceTemperature_K)) / (k_eV * to_K);
}

// Parameters of `translation.device`, in its order, at irradiance G in W/m2 and cell temperature T
// in kelvin. Idealities are multiplied by T / Tref. S may be a dual number.
//
//   IL  = G / Gref (IL_ref + alpha_sc (T - Tref))
//   De Soto, Klein and Beckman 2006 (doi:10.1016/j.solener.2005.06.010), eqs. 16 to 18, 21, 22:
//     Io  = Io_ref (T / Tref)^3 exp(EgRef / (k Tref) - Eg / (k T))
//     Eg  = EgRef (1 + dEgdT (T - Tref)), n constant, Rsh = Rsh_ref Gref / G
//   CEC (Dobos 2012, doi:10.1115/1.4005759): De Soto's with alpha_sc (1 - Adjust / 100) in IL,
//     where alpha_sc is the measured coefficient of Isc
//   PVsyst (Mermoud and Lejeune 2010; Sauer, Roessler and Hansen 2015,
//   doi:10.1109/JPHOTOV.2014.2364133):
//     gamma = gamma_ref + mu_gamma (T - Tref)
//     Io    = Io_ref (T / Tref)^3 exp(EgRef / (k gamma) (1 / Tref - 1 / T))
//     Rsh   = base + (R_sh_0 - base) exp(-R_sh_exp G / Gref), so that Rsh(Gref) = R_sh_ref
//   recombination diode (Gow and Manning 1999, doi:10.1049/ip-epa:19990116):
//     Io2 = Io2_ref (T / Tref)^(5/2) exp((EgRef / (k Tref) - Eg / (k T)) / 2)
template <class S>
void Translate(const Translation& translation, const S* shared, const S& irradiance_W_m2,
               const S& temperature_K, S* device) {
  using std::exp;
  using std::sqrt;
  const Translation& at = translation;
  const double k_eV = ThermalVoltage(1.0, at.spec.constants);  // k / q: eV per kelvin
  const S g = irradiance_W_m2 / kReferenceIrradiance_W_m2;
  const S dt = temperature_K - kReferenceTemperature_K;
  const S ratio = temperature_K / kReferenceTemperature_K;
  const S& gap = shared[at.bandgap];
  const bool pvsyst = at.spec.law == TranslationLaw::kPvsyst;
  const S n = pvsyst ? S(shared[at.n] + shared[at.n_slope] * dt) : S(shared[at.n]);
  const S slope = pvsyst ? S(0.0) : shared[at.bandgap_slope];
  const S barrier = DeSotoBarrier(gap, slope, kReferenceTemperature_K, temperature_K, k_eV);
  const S alpha = at.adjust >= 0 ? S(shared[at.alpha_sc] * (1.0 - 0.01 * shared[at.adjust]))
                                 : S(shared[at.alpha_sc]);
  device[kIph] = g * (shared[at.photocurrent] + alpha * dt);
  device[SaturationCurrentIndex(0)] = shared[at.saturation_current] * ratio * ratio * ratio *
                                      exp(pvsyst ? S(barrier / n) : barrier);
  device[IdealityIndex(0)] = n * ratio;
  device[kRs] = shared[at.resistance_series];
  device[kRsh] = ShuntAt(at, shared, g);
  if (at.n_2 >= 0) {
    device[SaturationCurrentIndex(1)] =
        shared[at.saturation_current_2] * ratio * ratio * sqrt(ratio) * exp(0.5 * barrier);
    device[IdealityIndex(1)] = shared[at.n_2] * ratio;
  }
  if (at.recombination >= 0) {
    const int last = at.device.size();
    device[last - 2] = shared[at.recombination];
    device[last - 1] = shared[at.built_in_voltage];
  }
}

// Translation in plain numbers, as a device at its own temperature: idealities without the factor T
// / Tref.
struct TranslatedDevice {
  Device device;
  std::vector<double> parameters;  // of `device`, in its order
};
TranslatedDevice TranslateTo(const Translation& translation, const std::vector<double>& shared,
                             double irradiance_W_m2, double temperature_K);

// Temperature coefficients of a device's key points at the reference conditions (1000 W/m2, 25 C),
// as data sheets state them.
struct TemperatureCoefficients {
  double alpha_sc_A_K;
  double beta_oc_V_K;
  double gamma_pmp_percent_K;  // percent of the maximum power at the reference, per K
};

// Computes the coefficients as central differences of the model's own key points, `half_step_K` on
// either side of the reference temperature. NaN for a device that gives no power.
TemperatureCoefficients CoefficientsAtReference(const Translation& translation,
                                                const std::vector<double>& shared,
                                                double half_step_K = 1);

}  // namespace lyrefit
