#pragma once

#include <optional>
#include <vector>

#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// The values of the inputs, and the model's outputs at any inputs. All outputs are NaN where the
// model returns too few.
std::vector<double> ValuesOf(const std::vector<UncertainInput>& inputs);
std::vector<double> EvaluateAt(const UncertainModel& model, const std::vector<double>& inputs);

// Range of a choice's answers for each output, including the reported values.
struct ChoiceRange {
  std::vector<double> low;
  std::vector<double> high;
  std::vector<char> against;  // falls where the first output that varies rises
};
ChoiceRange RangeOf(const OutputChoice& choice, const std::vector<double>& reported);

// The law of propagation of uncertainty (JCGM 100, clause 5): adds a line for each source, and the
// value and standard uncertainty of each output.
void AddLinearBudget(const UncertainModel& model, const UncertaintySources& sources,
                     UncertaintyBudget* budget);

// Checks each linear interval against the drawn interval (JCGM 101, clause 8). Stores in every
// output of `budget` whether both ends agree within the numerical tolerance. Where they do not, the
// output's sentence states the reasons.
void JudgeAgreement(const UncertainModel& model, const UncertaintySources& sources,
                    int significant_digits, UncertaintyBudget* budget);

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
