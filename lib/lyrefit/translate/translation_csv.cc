#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translation_documents.h"
#include "lyrefit/translate/translation_report.h"

namespace lyrefit {

std::string TranslationCsv(const TranslationReport& report) {
  std::string text =
      "curve,irradiance_Wm2,temperature_C,procedure,recommended,isc_A,isc_A_U,voc_V,voc_V_U,imp_A,"
      "imp_A_U,vmp_V,vmp_V_U,pmax_W,pmax_W_U,fill_factor,fill_factor_U,why_not\n";
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const TranslatedResult& result = report.results[i];
    std::vector<std::string> fields = {
        CsvField(report.curve.name), CsvField(report.target.irradiance_W_m2),
        CsvField(report.target.temperature_C), ToText(result.procedure),
        static_cast<int>(i) == report.recommended ? "yes" : "no"};
    const std::vector<double> values = KeyPointVector(result.key_points);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool known = k < result.budget.outputs.size();
      fields.push_back(CsvField(result.computed() ? values[k] : kUnknown));
      fields.push_back(CsvField(known ? result.budget.outputs[k].expanded_uncertainty : kUnknown));
    }
    fields.push_back(CsvField(result.why_not));
    text += CsvLine(fields);
  }
  return text;
}

}  // namespace lyrefit
