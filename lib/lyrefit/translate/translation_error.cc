#include "lyrefit/translate/translation_budget.h"

namespace lyrefit {
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
