#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/model/effect.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// The catalogue in the words of the setup, then the caller's own effects, in the order of reports.
// Errors: an own effect that cannot be fitted or whose id is already used; a requested id that does not
// exist.
Expected<std::vector<const Effect*>> KnownEffects(const DiagnoseOptions& options,
                                                  Setup setup = Setup::kUnknown);

// Whether an effect is among the requested ones (none requested: all).
bool IsWanted(const Effect& effect, const DiagnoseOptions& options);

// Why an effect is no candidate in these circumstances; null: it is one. Who asks for it by name, or
// states how common it is, gets it.
const char* WhyExcluded(const Effect& effect, const DiagnoseOptions& options);

// The effects of `known` that are found by scores and fits, in data with these traits.
std::vector<const Effect*> Candidates(const std::vector<const Effect*>& known,
                                      const DataTraits& traits, const DiagnoseOptions& options);

// The setup in which a measurement is judged: as asked for, or as its file states it, or by the times
// of a flash.
JudgedSetup SetupOf(const CurveSet& set, const DiagnoseOptions& options);

// What is known of a measurement beside its readings.
Circumstances CircumstancesOf(const Readings& readings, const std::string& technology,
                              const DiagnoseOptions& options);

// An effect in the words of the setup. Nothing shades a flasher: what draws such a curve there are
// cells that give unlike currents, or a lamp that lights them unlike.
const Effect* InWordsOf(Setup setup, const Effect* effect);

}  // namespace lyrefit
