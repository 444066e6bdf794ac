#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translate.h"
#include "translate/carried.h"
#include "translate/study.h"

namespace shown {
namespace {

using lyrefit::Procedure;

struct Labelled {
  std::string name;
  std::string label;
};

std::vector<Labelled> Labels(const std::string& folder) {
  std::vector<Labelled> cases;
  std::ifstream in(folder + "/labels.csv");
  std::string line;
  std::getline(in, line);  // header
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    Labelled each;
    std::getline(cells, each.name, ',');
    std::getline(cells, each.label, ',');
    cases.push_back(each);
  }
  return cases;
}

std::string RowOf(const std::string& folder, const Labelled& each) {
  char text[400];
  const auto curve = lyrefit::ReadCurve(folder + "/" + each.name + ".csv");
  if (!curve) return "| " + each.name + " | " + curve.error().message + " |\n";
  lyrefit::TranslateOptions options = ReadyOptions(true);
  options.uncertainty.threads = 1;
  options.uncertainty.draws = 1000;
  const auto report = lyrefit::TranslateCurve(*curve, options);
  if (!report)
    return "| " + each.name + " | " + each.label + " | " + report.error().message + " |\n";
  std::snprintf(text, sizeof text, "| %s | %s | %.0f, %.0f |", each.name.c_str(),
                each.label.c_str(), curve->conditions.irradiance_W_m2,
                curve->conditions.cell_temperature_K - lyrefit::kZeroCelsius_K);
  std::string row = text;
  double lowest = 1e300, highest = 0;
  for (const lyrefit::TranslatedResult& result : report->results) {
    if (result.procedure == Procedure::kIec3) continue;
    if (!result.computed()) {
      row += " - |";
      continue;
    }
    const double power = result.key_points.max_power_W;
    lowest = std::min(lowest, power);
    highest = std::max(highest, power);
    std::snprintf(text, sizeof text, " %.4g |", power);
    row += text;
  }
  const lyrefit::TranslatedResult* best = report->Recommended();
  if (best == nullptr) return row + " none: " + report->reason + " |\n";
  std::string causes;
  for (const std::string& cause : report->causes) causes += (causes.empty() ? "" : " ") + cause;
  const double expanded = best->budget.outputs.empty()
                              ? lyrefit::kUnknown
                              : best->budget.outputs[lyrefit::kMaxPowerOutput].expanded_uncertainty;
  const double power = best->key_points.max_power_W;
  std::snprintf(text, sizeof text, " %s | %.1f %% | %.1f %% | %s |\n",
                lyrefit::ToText(best->procedure).c_str(), 100 * expanded / power,
                100 * (highest - lowest) / power, causes.c_str());
  return row + text;
}

}  // namespace

int StudyReal(const StudyOptions& options) {
  const std::string folder = options.data + "/field/single";
  const std::vector<Labelled> cases = Labels(folder);
  if (cases.empty()) {
    std::fprintf(stderr, "%s/labels.csv has no cases\n", folder.c_str());
    return 1;
  }
  std::printf(
      "| case | label | W/m2, C | iec1 | iec2 | iec4 | desoto | pvsyst | extended | recommended | "
      "U | "
      "spread | causes |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<std::string> rows(cases.size());
  lyrefit::ParallelFor(static_cast<int>(cases.size()), options.threads,
                       [&](int i) { rows[i] = RowOf(folder, cases[i]); });
  for (const std::string& row : rows) std::printf("%s", row.c_str());
  return 0;
}

}  // namespace shown
