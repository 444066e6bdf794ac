#include "faults/study_field.h"

#include <cstdio>
#include <filesystem>

namespace faults {
namespace {

void WriteReadings(const Measurement& taken, std::FILE* to) {
  std::fprintf(to, "voltage_V,current_A%s%s\n", taken.time.empty() ? "" : ",time_s",
               taken.sweep.empty() ? "" : ",sweep");
  for (std::size_t i = 0; i < taken.voltage.size(); ++i) {
    std::fprintf(to, "%.7g,%.7g", taken.voltage[i], taken.current[i]);
    if (!taken.time.empty()) std::fprintf(to, ",%.6g", taken.time[i]);
    if (!taken.sweep.empty()) std::fprintf(to, ",%d", taken.sweep[i]);
    std::fprintf(to, "\n");
  }
}

void WriteNotes(const std::string& name, const Measurement& taken, std::FILE* to) {
  std::fprintf(to,
               "{\"name\": \"%s\", \"cells_in_series\": %d, \"technology\": \"mono-Si\", "
               "\"nominal_temperature_C\": %.1f, \"nominal_irradiance_Wm2\": %.0f, "
               "\"bypass_diodes\": %d}\n",
               name.c_str(), taken.cells, taken.temperature[0], taken.irradiance[0],
               taken.bypass_diodes);
}

}  // namespace

int DumpFieldCases(const StudyOptions& options, const std::vector<std::string>& kinds, int cases) {
  namespace fs = std::filesystem;
  std::error_code failed;
  fs::create_directories(options.dump, failed);
  std::FILE* labels = std::fopen((options.dump + "/labels.csv").c_str(), "w");
  if (labels == nullptr) return std::perror(options.dump.c_str()), 1;
  std::fputs("case,label,accepted_first_names,source,note,points\n", labels);
  for (const std::string& kind : kinds) {
    for (int i = 0; i < cases; ++i) {
      const field::Case made = FieldCase(options, kind, i);
      const std::string name = kind + "_" + std::to_string(i);
      std::FILE* table = std::fopen((options.dump + "/" + name + ".csv").c_str(), "w");
      std::FILE* notes = std::fopen((options.dump + "/" + name + ".json").c_str(), "w");
      if (table == nullptr || notes == nullptr) return std::perror(name.c_str()), 1;
      WriteReadings(made.measurement, table);
      WriteNotes(name, made.measurement, notes);
      std::fclose(table);
      std::fclose(notes);
      std::fprintf(labels, "%s,%s,%s,%s,\"misfit %.3f %% of Isc; %s\",%zu\n", name.c_str(),
                   made.truth.accepted.empty() ? "clean" : "fault",
                   Joined(made.truth.accepted).c_str(), kind.c_str(), made.misfit,
                   FiguresOf(made).c_str(), made.measurement.voltage.size());
    }
  }
  std::fclose(labels);
  return 0;
}

int ShowFieldCase(const StudyOptions& options) {
  const field::Case made = FieldCase(options, options.show, options.number);
  std::fprintf(stderr, "%s: misfit %.3f %% of Isc (%.3f healthy); %s; right: %s%s\n",
               made.kind.c_str(), made.misfit, made.healthy, FiguresOf(made).c_str(),
               Joined(made.truth.accepted).c_str(), made.make.half_cut ? "; half-cut" : "");
  WriteNotes(made.kind + "_" + std::to_string(options.number), made.measurement, stderr);
  WriteReadings(made.measurement, stdout);
  return 0;
}

}  // namespace faults
