#include <algorithm>

#include "lyrefit/base/numbers.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {

std::string DataSheetCsv(const DataSheetFit& fit) {
  std::string csv = "parameter,name,unit,value,low,high\n";
  for (std::size_t k = 0; k < fit.shared.size(); ++k) {
    const ParameterInfo& info = fit.translation.parameters[k];
    const auto range =
        std::find_if(fit.ranges.begin(), fit.ranges.end(),
                     [&info](const DataSheetRange& r) { return r.name == info.name; });
    const bool ranged = range != fit.ranges.end();
    csv += CsvLine({CsvField(info.symbol), CsvField(info.name), CsvField(info.unit),
                    CsvField(fit.shared[k]), CsvField(ranged ? range->low : kUnknown),
                    CsvField(ranged ? range->high : kUnknown)});
  }
  return csv;
}

}  // namespace lyrefit
