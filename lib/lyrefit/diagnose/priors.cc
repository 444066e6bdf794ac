#include "lyrefit/diagnose/priors.h"

namespace lyrefit {

const std::vector<CausePrior>& DefaultPriors() {
  static const char* const kShade = "soiling, snow and shade: most frequent in field sweeps";
  static const char* const kFault = "IEA PVPS T13-01:2014, section 5: failures per module";
  static const char* const kCell = "not rare in cells, seldom above the floors";
  static const char* const kSky = "moving clouds: a few in a hundred sweeps of 0.1 to 30 s";
  static const char* const kTracer = "properties of tracers, per instrument";
  static const std::vector<CausePrior> table = {
      {"second_diode", 0.05, kCell},   {"nonohmic_shunt", 0.03, kCell},
      {"breakdown", 0.02, kCell},      {"collection", 0.02, kCell},
      {"photoshunt", 0.02, kCell},     {"back_contact", 0.02, kCell},
      {"rs_current", 0.01, kCell},     {"distributed_rs", 0.02, kCell},
      {"shading", 0.03, kShade},       {"substrings", 0.03, kShade},
      {"weak_cell", 0.03, kFault},     {"mismatch", 0.02, kFault},
      {"leaky_cell", 0.01, kFault},    {"scatter", 0.02, kFault},
      {"bypass_short", 0.01, kFault},  {"bypass_open", 0.005, kFault},
      {"irr_step", 0.02, kSky},        {"transient", 0.02, kSky},
      {"drift", 0.01, kSky},           {"temp_drift", 0.003, kSky},
      {"capacitance", 0.03, kTracer},  {"timing_skew", 0.02, kTracer},
      {"range_switch", 0.005, kTracer}, {"clip", 0.005, kTracer},
  };
  return table;
}

double PriorOf(const std::string& id, const std::map<std::string, double>& own) {
  if (const auto at = own.find(id); at != own.end()) return at->second;
  for (const CausePrior& prior : DefaultPriors()) {
    if (id == prior.id) return prior.probability;
  }
  return kOtherPrior;
}

}  // namespace lyrefit
