#pragma once

#include <string>
#include <utility>

#include "lyrefit/study/audit.h"

namespace lyrefit {

inline AuditReading SampleReading(double measured_A) {
  AuditReading reading;
  reading.curve = "cell";
  reading.temperature_C = 33.0 + 6e-14;
  reading.constants = {ConstantSet::kLiterature};
  reading.shown = ConstantSet::kLiterature;
  reading.parameters = {0.76, 3.2e-7, 1.48, 0.0363, 53.7};
  reading.half_units = {0.005, 0.5e-8, 0.005, 0.00005, 0.05};
  reading.rmse = {measured_A, 7.754e-4};
  reading.figure_A = measured_A;
  reading.tolerance_A = 1e-7;
  return reading;
}

inline AuditFinding SampleFinding(const std::string& source, const std::string& algorithm,
                                  AuditVerdict verdict) {
  AuditFinding finding;
  finding.row.source = source;
  finding.row.device = "cell";
  finding.row.algorithm = algorithm;
  finding.row.rmse.text = "9.8602E-04";
  finding.row.rmse.value = 9.8602e-4;
  finding.row.rmse.half_unit = 0.5e-8;
  finding.row.line = 7;
  finding.verdict = verdict;
  finding.stated = SampleReading(9.860219e-4);
  finding.sentence = "What is to be said about " + algorithm + ", in short.";
  return finding;
}

// An audit written by hand: two tables with rows of different verdicts, and one row that could not
// be read.
inline AuditReport SampleAudit() {
  AuditReport report;
  report.version = "1.2.3";
  report.path = "rows.csv";
  report.findings.push_back(SampleFinding("Table 1", "good", AuditVerdict::kReproduces));
  AuditFinding changed = SampleFinding("Table 1", "a, b", AuditVerdict::kReproducesChanged);
  changed.stated.constants.clear();
  changed.bounds_name = "paper";
  AuditExplanation explanation;
  explanation.reading = SampleReading(9.86021e-4);
  explanation.reading.changes = {"with Is1 in A instead of uA", "at 75 C in place of 33 C"};
  explanation.reading.temperature_C = 75;
  const Device device = MakeDevice(Model::kSingleDiode, {});
  explanation.reading.left_bounds = {{device.parameters[kRs], 0.0363, 0.2, 0.4}};
  explanation.low_temperature_C = 74.999;
  explanation.high_temperature_C = 75.001;
  explanation.readings_tried = 474;
  explanation.chance = 0.003;
  changed.explanations = {explanation};
  report.findings.push_back(std::move(changed));
  AuditFinding fails = SampleFinding("Table 2", "bad", AuditVerdict::kFails);
  fails.stated.constants.clear();
  fails.stated.left_bounds = {{device.parameters[kRsh], 153, 0, 100}};
  fails.bounds_name = "paper";
  fails.temperatures = AuditTemperatures{{31.5, 34.25}, 33.1, 9.5e-4};
  fails.nearest = explanation;
  fails.optimum_A = 9.8602187e-4;
  fails.short_circuit_A = 0.7605;
  report.findings.push_back(std::move(fails));
  report.bad_rows.push_back({"expected a number, found 'x'", "rows.csv", 9, 4});
  return report;
}

}  // namespace lyrefit
