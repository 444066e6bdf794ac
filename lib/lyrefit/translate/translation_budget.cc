#include "lyrefit/translate/translation_budget.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/translate/extended_model.h"
#include "lyrefit/translate/field_inputs.h"

namespace lyrefit {
namespace {

constexpr double kErrorFactor = 2;  // coverage factor of the procedures' errors
constexpr double kKelvinStep = 10;

OutputTerm TranslationTerm(Procedure procedure, const PreparedCurve& curve,
                           const TranslationInputs& inputs, const std::vector<double>& translated,
                           const UncertaintyOptions& options) {
  const TranslationError error = TranslationErrorOf(procedure);
  const double folds =
      std::fabs(std::log(curve.target.irradiance_W_m2 / EquivalentIrradiance(inputs)));
  const double steps = std::fabs(curve.target.temperature_C - inputs.temperature_C) / kKelvinStep;
  std::vector<double> sizes(translated.size());
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    sizes[k] =
        std::hypot(error.light[k] * std::sqrt(folds), error.temperature[k] * std::sqrt(steps));
  }
  OutputTerm term = {
      "translation", "translation by " + ToText(procedure), "translation", error.source, {}};
  if (options.translation_percent) {
    // The errors of the other outputs keep their ratio to that of Pmax.
    const double usual = sizes[kMaxPowerOutput];
    const double stated = *options.translation_percent / 100;
    for (double& size : sizes) size = usual > 0 ? size / usual * stated : stated;
    term.source = "stated";
  }
  term.factors.push_back(std::move(sizes));
  for (std::size_t k = 0; k < translated.size(); ++k) {
    term.factors[0][k] *= translated[k] / kErrorFactor;
  }
  return term;
}

// Choice among the results of other procedures; those without a result are left out.
OutputChoice ProcedureChoice(const std::vector<Procedure>& alternatives, const PreparedCurve& curve,
                             const TranslationInputs& inputs) {
  OutputChoice choice = {"procedure",
                         "choice of the procedure",
                         "translation",
                         "spread of the answers of procedures that are as good a choice",
                         {}};
  for (const Procedure procedure : alternatives) {
    const auto key = TranslatedKeyPoints(procedure, curve, inputs);
    if (key) choice.answers.push_back(KeyPointVector(*key));
  }
  return choice;
}

OutputChoice CauseChoice(Procedure procedure, const PreparedCurve& curve,
                         const TranslationInputs& inputs) {
  OutputChoice choice = {"cause",
                         "choice among equivalent causes",
                         "cause",
                         "spread of the answers of causes that explain the curve as well",
                         {}};
  for (int alternative = 1; alternative < static_cast<int>(curve.models.size()); ++alternative) {
    const auto key = TranslatedKeyPoints(procedure, curve, inputs, alternative);
    if (key) choice.answers.push_back(KeyPointVector(*key));
  }
  return choice;
}

// A removed cause of the sweep may belong to the device after all, which only another sweep can
// decide. The other answer is the uncorrected readings, translated as those of a faultless module.
OutputChoice RemovalChoice(const PreparedCurve& curve, const TranslationInputs& inputs) {
  OutputChoice choice = {"removal",
                         "what was taken out of the sweep",
                         "cause",
                         fmt::format("with and without {}; a further sweep would tell",
                                     fmt::join(curve.models.front()->removed, ", ")),
                         {}};
  for (const Procedure procedure : {Procedure::kDeSoto, Procedure::kIec4, Procedure::kIec2}) {
    const auto key = TranslatedKeyPoints(procedure, curve, inputs);
    if (!key) continue;
    choice.answers.push_back(KeyPointVector(*key));
    break;
  }
  return choice;
}

}  // namespace

Expected<UncertaintyBudget> TranslationBudget(Procedure procedure, const PreparedCurve& curve,
                                              const SettledInputs& settled,
                                              const TranslationDoubts& doubts,
                                              const UncertaintyOptions& options,
                                              const Observer& observer) {
  const TranslationInputs& inputs = settled.values;
  TRY(const KeyPoints key, TranslatedKeyPoints(procedure, curve, inputs));
  const std::vector<double> translated = KeyPointVector(key);
  UncertaintySources sources = {FieldInputs(settled, options)};
  const KeyPointNoise noise = doubts.noise ? *doubts.noise : NoiseOfCurve(curve, options.seed);
  sources.terms.push_back(NoiseTerm(noise, translated));
  if (doubts.alternatives.empty()) {
    sources.terms.push_back(TranslationTerm(procedure, curve, inputs, translated, options));
  } else {
    sources.choices.push_back(ProcedureChoice(doubts.alternatives, curve, inputs));
  }
  if (procedure == Procedure::kExtended && curve.models.size() > 1) {
    sources.choices.push_back(CauseChoice(procedure, curve, inputs));
  }
  if (procedure == Procedure::kExtended && !curve.models.empty() &&
      !curve.models.front()->removed.empty()) {
    sources.choices.push_back(RemovalChoice(curve, inputs));
  }
  const InputFields fields = FieldsOf(sources.inputs);
  UncertainModel model;
  model.outputs = KeyPointQuantities();
  model.evaluate = [&](const std::vector<double>& drawn) -> std::vector<double> {
    const auto moved =
        TranslatedKeyPoints(procedure, curve, WithInputs(inputs, sources.inputs, fields, drawn));
    return moved ? KeyPointVector(*moved) : std::vector<double>{};
  };
  return Propagate(model, sources, options, observer);
}

namespace {

struct ErrorRow {
  Procedure procedure;
  std::vector<double> light;  // Isc, Voc, Imp, Vmp, Pmax, FF
  std::vector<double> temperature;
  const char* source;
};

// Pmax is from all data sets, the other outputs from the first set only: errors of a procedure
// differ between modules. The README of the module lists the sizes of each set.
constexpr char kMeasured[] =
    "Pmax: of pairs of outdoor sweeps of two crystalline silicon modules (Sandia, 200 to 1200 "
    "W/m2, "
    "8 to 66 C; NIST, two days) and of made devices by other laws, less what sweeps in like "
    "conditions differ by; the rest in proportion, by the first of them";
constexpr char kFaulty[] =
    "Pmax: of modules made of single cells with faults of the device; the rest in proportion, by "
    "judgement";
constexpr char kAsSecond[] = "not measured: as procedure 2";

const std::vector<ErrorRow>& Rows() {
  static const std::vector<ErrorRow> rows = {
      {Procedure::kIec1,
       {0.0015, 0.006, 0.021, 0.024, 0.045, 0.043},
       {0.0005, 0.0010, 0.008, 0.002, 0.004, 0.006},
       kMeasured},
      {Procedure::kIec2,
       {0.0015, 0.006, 0.026, 0.025, 0.042, 0.042},
       {0.0005, 0.0010, 0.005, 0.0010, 0.002, 0.002},
       kMeasured},
      {Procedure::kIec3,
       {0.0015, 0.006, 0.026, 0.025, 0.042, 0.042},
       {0.0005, 0.0010, 0.005, 0.0010, 0.002, 0.002},
       kAsSecond},
      {Procedure::kIec4,
       {0.0015, 0.006, 0.024, 0.020, 0.039, 0.036},
       {0.0010, 0.0010, 0.006, 0.002, 0.004, 0.004},
       kMeasured},
      {Procedure::kDeSoto,
       {0.0012, 0.006, 0.016, 0.021, 0.028, 0.025},
       {0.0010, 0.0010, 0.004, 0.0010, 0.006, 0.007},
       kMeasured},
      {Procedure::kPvsyst,
       {0.0010, 0.006, 0.018, 0.023, 0.040, 0.035},
       {0.0010, 0.0010, 0.008, 0.0010, 0.003, 0.006},
       kMeasured},
      {Procedure::kExtended,
       {0.0040, 0.006, 0.030, 0.028, 0.048, 0.042},
       {0.0010, 0.0010, 0.004, 0.0010, 0.006, 0.007},
       kFaulty},
  };
  return rows;
}

}  // namespace

TranslationError TranslationErrorOf(Procedure procedure) {
  for (const ErrorRow& row : Rows()) {
    if (row.procedure == procedure) return {row.light, row.temperature, row.source};
  }
  return {};
}

}  // namespace lyrefit
