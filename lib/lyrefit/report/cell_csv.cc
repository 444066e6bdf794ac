#include <cmath>

#include "lyrefit/estimate/cell/cell_report.h"
#include "lyrefit/report/csv.h"

namespace lyrefit {
namespace {

// Value of a parameter of the sweep's fit; NaN where it is void.
double DiodeValue(const CellSweep& sweep, const std::string& symbol) {
  if (!sweep.diode()) return kUnknown;
  for (const Estimate& e : sweep.fit->estimates) {
    if (e.info.symbol == symbol) return e.refined;
  }
  return kUnknown;
}

std::string SweepLine(const CellReport& report, const CellSweep& sweep) {
  const KeyPoints& key = sweep.key;
  std::string stopped;
  for (const std::string& reason : sweep.void_because) {
    stopped += (stopped.empty() ? "" : "; ") + reason;
  }
  std::vector<std::string> fields = {CsvField(report.name), CsvField(sweep.file),
                                     CsvField(sweep.name), ToText(sweep.kind),
                                     ToText(sweep.direction)};
  for (const double value :
       {sweep.irradiance_W_m2, report.temperature_C, report.area_cm2, key.short_circuit_current_A,
        sweep.jsc_mA_cm2, key.open_circuit_voltage_V, key.max_power_voltage_V,
        key.max_power_current_A, key.max_power_W, key.fill_factor, sweep.efficiency,
        sweep.resistance_at_isc_ohm, sweep.resistance_at_voc_ohm, DiodeValue(sweep, "n1"),
        DiodeValue(sweep, "Rs"), DiodeValue(sweep, "Rsh")}) {
    fields.push_back(CsvField(value));
  }
  fields.push_back(CsvField(stopped));
  return CsvLine(fields);
}

}  // namespace

std::string CellCsv(const CellReport& report) {
  std::string csv =
      "cell,file,sweep,kind,direction,irradiance_Wm2,temperature_C,area_cm2,isc_A,jsc_mA_cm2,voc_V,"
      "vmp_V,imp_A,pmp_W,fill_factor,efficiency,resistance_at_isc_ohm,resistance_at_voc_ohm,n,"
      "Rs_ohm,Rsh_ohm,void\n";
  for (const CellSweep& sweep : report.sweeps) csv += SweepLine(report, sweep);
  return csv;
}

}  // namespace lyrefit
