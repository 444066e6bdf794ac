#include "lyrefit/translate/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/translate/extended_model.h"
#include "lyrefit/translate/procedure_steps.h"

namespace lyrefit {
namespace {

constexpr double kSmallLight = 0.10;  // |ln G2 / G1|
constexpr double kSmall_K = 5;
constexpr double kMiddleLight = 0.3;
constexpr double kLowShunt = 10;  // Rsh Isc / Voc: below it the fill factor of a normal module is
                                  // impossible

struct Step {
  double light;   // |ln|
  double heat_K;  // absolute
};

Step StepOf(const Preparation& made) {
  const TranslationInputs& at = made.inputs.values;
  return {std::fabs(std::log(made.curve.target.irradiance_W_m2 / EquivalentIrradiance(at))),
          std::fabs(made.curve.target.temperature_C - at.temperature_C)};
}

// Rsh Isc / Voc of the diagnosed device, or of the single-diode fit.
double ShuntOf(const Preparation& made) {
  const KeyPoints key =
      KeyPointsBy(KeyPointMethod::kInterpolated, TruePoints(made.curve.points, made.inputs.values));
  double shunt = made.curve.diode ? made.curve.diode->resistance_shunt_ohm : kInfinity;
  if (made.diagnosis) {
    for (const Estimate& estimate : made.diagnosis->extended.estimates) {
      if (estimate.info.symbol == "Rsh") shunt = estimate.refined;
    }
  }
  const CurvePoints& read = made.curve.points;
  // For readings that end before an axis, the largest reading is a sufficient estimate.
  const double voc = std::isfinite(key.open_circuit_voltage_V)
                         ? key.open_circuit_voltage_V
                         : *std::max_element(read.voltage_V.begin(), read.voltage_V.end());
  const double isc = std::isfinite(key.short_circuit_current_A)
                         ? key.short_circuit_current_A
                         : *std::max_element(read.current_A.begin(), read.current_A.end());
  return shunt * isc / voc;
}

std::string CauseTitles(const Diagnosis& diagnosis) {
  std::string titles;
  for (const Cause& cause : diagnosis.verdict.causes) {
    titles += (titles.empty() ? "" : ", ") + cause.title;
  }
  return titles;
}

class Choosing {
 public:
  Choosing(const Preparation& made, const std::vector<TranslatedResult>& results)
      : made_(made), results_(results), step_(StepOf(made)) {}

  Recommendation Choose() const {
    Recommendation chosen;
    if (ByCause(&chosen) || ByCurves(&chosen) || BySmallStep(&chosen) || ByLargeStep(&chosen)) {
      return chosen;
    }
    for (const Procedure procedure :
         {Procedure::kDeSoto, Procedure::kIec4, Procedure::kIec2, Procedure::kIec1,
          Procedure::kPvsyst, Procedure::kExtended, Procedure::kIec3}) {
      if (Take(procedure, "the others could not be computed", &chosen)) return chosen;
    }
    chosen.reason = "no procedure could be computed";
    return chosen;
  }

 private:
  bool Take(Procedure procedure, const std::string& reason, Recommendation* chosen) const {
    for (std::size_t i = 0; i < results_.size(); ++i) {
      if (results_[i].procedure != procedure || !results_[i].computed()) continue;
      *chosen = {static_cast<int>(i), reason};
      return true;
    }
    return false;
  }

  bool ByCause(Recommendation* chosen) const {
    if (made_.diagnosis && !made_.diagnosis->verdict.causes.empty() &&
        !made_.curve.models.empty()) {
      const bool in_device = !made_.curve.models.front()->kept.empty();
      return Take(
          Procedure::kExtended,
          "the curve shows " + CauseTitles(*made_.diagnosis) +
              (in_device ? ": the other procedures carry it as the shape of a healthy module"
                         : ": no property of the device, and no other procedure takes it out"),
          chosen);
    }
    const double shunt = ShuntOf(made_);
    if (!(shunt < kLowShunt)) return false;
    return Take(Procedure::kExtended,
                fmt::format("the shunt is low (Rsh is {:.1f} times Voc / Isc): the other "
                            "procedures have it follow the light or move it with the points",
                            shunt),
                chosen);
  }

  bool ByCurves(Recommendation* chosen) const {
    const double place = PlaceBetween(made_.curve, made_.inputs.values);
    if (!(place >= 0 && place <= 1)) return false;
    return Take(Procedure::kIec3,
                "the target lies between measured curves: nothing has to be assumed of the device",
                chosen);
  }

  bool BySmallStep(Recommendation* chosen) const {
    if (step_.light > kSmallLight || step_.heat_K > kSmall_K) return false;
    if (!made_.inputs.beta_scatter) {
      return Take(Procedure::kIec1,
                  "the step is small: points moved by the stated coefficients, no model in between",
                  chosen);
    }
    return made_.inputs.crystalline_silicon &&
           Take(Procedure::kIec4,
                "the step is small and nobody stated beta, which procedure 4 does without", chosen);
  }

  bool ByLargeStep(Recommendation* chosen) const {
    if (made_.inputs.beta_scatter && made_.inputs.crystalline_silicon &&
        step_.light <= kMiddleLight) {
      return Take(Procedure::kIec4,
                  "nobody stated beta, which procedure 4 does without for crystalline silicon",
                  chosen);
    }
    return Take(Procedure::kDeSoto,
                "the step is large: the law of a diode, whose shunt goes with the light, did best "
                "on measured curves",
                chosen);
  }

  const Preparation& made_;
  const std::vector<TranslatedResult>& results_;
  Step step_;
};

}  // namespace

Recommendation Recommend(const Preparation& made, const std::vector<TranslatedResult>& results) {
  return Choosing(made, results).Choose();
}

}  // namespace lyrefit
