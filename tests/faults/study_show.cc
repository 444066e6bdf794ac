#include <cstdio>

#include "faults/study.h"

namespace faults {
namespace {

void PrintReadings(const Measurement& taken) {
  std::printf("voltage_V,current_A,sweep,irradiance_Wm2,temperature_C%s\n",
              taken.time.empty() ? "" : ",time_s");
  for (std::size_t i = 0; i < taken.voltage.size(); ++i) {
    const int sweep = taken.sweep.empty() ? 0 : taken.sweep[i];
    std::printf("%.7g,%.7g,%d,%g,%g", taken.voltage[i], taken.current[i], sweep,
                taken.irradiance[i], taken.temperature[i]);
    if (!taken.time.empty()) std::printf(",%.6g", taken.time[i]);
    std::printf("\n");
  }
}

}  // namespace

int ShowCase(const StudyOptions& options) {
  const Kind kind = KindsCalled(options.kind).front();
  std::optional<Case> made = NullFor(options, kind, options.number);
  std::uint64_t seed = SeedOf(options.seed, options.number);
  if (options.effect != "all") {
    const Request request =
        RequestFor(options, kind, *FindInjection(options.effect), options.number, 3, 25);
    made = MakeCase(request);
    seed = request.seed;
  }
  if (!made) {
    std::fprintf(stderr, "no device has room for it\n");
    return 1;
  }
  const Measurement& taken = made->measurement;
  for (const Cause& cause : made->causes) {
    std::fprintf(stderr, "%s: strength %g, misfit %g", cause.name.c_str(), cause.strength,
                 cause.misfit);
    if (cause.size.unit != nullptr) {
      std::fprintf(stderr, ", size %g %s", cause.size.value, cause.size.unit);
    }
    std::fprintf(stderr, "\n");
  }
  std::fprintf(stderr, "absorbed: %s%s\n", made->absorbed.c_str(),
               made->second_diode ? "; two diodes" : "");
  std::fprintf(stderr, "cells %d, bypass diodes %d, band gap %g eV, tempco %g/K, %s noise\n",
               taken.cells, taken.bypass_diodes, taken.bandgap_eV, taken.isc_tempco_per_K,
               Name(made->noise));
  const Answer answer =
      Ask(taken, options.number, options.probability, seed, false, ModeOf(options));
  std::fprintf(stderr, "answer: %s\n", Text(answer).c_str());
  for (const Claim& claim : answer.claims) {
    for (const Strength& strength : claim.strengths) {
      std::fprintf(stderr, "  %s %s = %g (%g to %g) %s\n", claim.id.c_str(),
                   strength.symbol.c_str(), strength.value, strength.low, strength.high,
                   strength.unit.c_str());
    }
  }
  PrintReadings(taken);
  return 0;
}

}  // namespace faults
