#pragma once

#include <optional>
#include <vector>

#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// Errors of a procedure itself at exact inputs, for each output: relative, expanded, k = 2, for a
// step of a factor e in irradiance and for a step of 10 K. Variances grow in proportion to the
// step, since measured errors grow slower than the step itself. The two variances add.
struct TranslationError {
  std::vector<double> light;  // Isc, Voc, Imp, Vmp, Pmax, FF
  std::vector<double> temperature;
  std::string source;
};
TranslationError TranslationErrorOf(Procedure procedure);

// Uncertainties of a translation besides its inputs.
struct TranslationDoubts {
  std::optional<KeyPointNoise> noise;  // of the readings; none: NoiseOfCurve
  // Procedures that were an equally good choice. Their spread gives a budget line that replaces the
  // procedure's own error.
  std::vector<Procedure> alternatives;
};

// Budget of the key points at the curve's target. Its lines are those of FieldInputs, noise,
// translation or choice of the procedure, and for the extended procedure the choices among
// equivalent causes (PreparedCurve::models) and about removed causes. Errors: those of
// TranslatedKeyPoints at the inputs' values, and of Propagate.
Expected<UncertaintyBudget> TranslationBudget(Procedure procedure, const PreparedCurve& curve,
                                              const SettledInputs& settled,
                                              const TranslationDoubts& doubts,
                                              const UncertaintyOptions& options,
                                              const Observer& observer = {});

}  // namespace lyrefit
