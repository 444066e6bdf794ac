#include <fmt/format.h>

#include <cmath>

#include "lyrefit/devices/cell_fields.h"
#include "lyrefit/devices/device_documents.h"
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
  std::vector<std::string> fields = {
      CsvField(report.name),          CsvField(sweep.file),
      CsvField(sweep.name),           ToText(sweep.kind),
      ToText(sweep.direction),        CsvField(sweep.irradiance_W_m2),
      CsvField(report.temperature_C), CsvField(report.area_cm2)};
  for (const CellField& field : CellFields()) {
    fields.push_back(CsvField(field.value(sweep)));
  }
  fields.push_back(CsvField(VoidReasons(sweep)));
  return CsvLine(fields);
}

}  // namespace

const std::vector<CellField>& CellFields() {
  using Sweep = CellSweep;
  static const std::vector<CellField> fields = {
      {"isc_A", "A", "short-circuit current",
       [](const Sweep& s) { return s.key.short_circuit_current_A; }},
      {"jsc_mA_cm2", "mA/cm2", "short-circuit current over the area",
       [](const Sweep& s) { return s.jsc_mA_cm2; }},
      {"voc_V", "V", "open-circuit voltage",
       [](const Sweep& s) { return s.key.open_circuit_voltage_V; }},
      {"vmp_V", "V", "voltage at maximum power",
       [](const Sweep& s) { return s.key.max_power_voltage_V; }},
      {"imp_A", "A", "current at maximum power",
       [](const Sweep& s) { return s.key.max_power_current_A; }},
      {"pmp_W", "W", "maximum power", [](const Sweep& s) { return s.key.max_power_W; }},
      {"fill_factor", "", "fill factor, a fraction",
       [](const Sweep& s) { return s.key.fill_factor; }},
      {"efficiency", "", "maximum power over irradiance times area, a fraction",
       [](const Sweep& s) { return s.efficiency; }},
      {"resistance_at_isc_ohm", "ohm", "-dV/dI at 0 V",
       [](const Sweep& s) { return s.resistance_at_isc_ohm; }},
      {"resistance_at_voc_ohm", "ohm", "-dV/dI at Voc",
       [](const Sweep& s) { return s.resistance_at_voc_ohm; }},
      {"n", "", "ideality of the single-diode fit; none where it is void",
       [](const Sweep& s) { return DiodeValue(s, "n1"); }},
      {"Rs_ohm", "ohm", "series resistance of that fit",
       [](const Sweep& s) { return DiodeValue(s, "Rs"); }},
      {"Rsh_ohm", "ohm", "shunt resistance of that fit",
       [](const Sweep& s) { return DiodeValue(s, "Rsh"); }},
  };
  return fields;
}

std::string VoidReasons(const CellSweep& sweep) {
  return fmt::format("{}", fmt::join(sweep.void_because, "; "));
}

std::string CellCsv(const CellReport& report) {
  std::string csv = "cell,file,sweep,kind,direction,irradiance_Wm2,temperature_C,area_cm2,";
  for (const CellField& field : CellFields()) csv += std::string(field.name) + ",";
  csv += "void\n";
  for (const CellSweep& sweep : report.sweeps) csv += SweepLine(report, sweep);
  return csv;
}

}  // namespace lyrefit
