#pragma once

#include <optional>
#include <vector>

#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// What a procedure itself gets wrong of each result although all its inputs are exact: in parts,
// expanded, k = 2, for a step of a factor e in the light and for one of 10 K. Variances grow in
// proportion to the step (what was measured does not grow as fast as the step itself) and add: no
// step, no error.
struct TranslationError {
  std::vector<double> light;  // Isc, Voc, Imp, Vmp, Pmax, FF
  std::vector<double> temperature;
  std::string source;
};
TranslationError TranslationErrorOf(Procedure procedure);

// What of a translation is uncertain besides its inputs.
struct TranslationDoubts {
  std::optional<KeyPointNoise> noise;  // of the readings; none: NoiseOfCurve
  // Others that were as good a choice. Their spread makes a line of its own; the procedure's own
  // error then is not counted a second time.
  std::vector<Procedure> alternatives;
};

// The budget of the key points at the curve's target: a line for each of FieldInputs, noise,
// translation, and the choice among the causes that explain as much (PreparedCurve::models, where
// the procedure uses them).
// Errors: those of TranslatedKeyPoints at the inputs as they are, and of Propagate.
Expected<UncertaintyBudget> TranslationBudget(Procedure procedure, const PreparedCurve& curve,
                                              const SettledInputs& settled,
                                              const TranslationDoubts& doubts,
                                              const UncertaintyOptions& options,
                                              const Observer& observer = {});

}  // namespace lyrefit
