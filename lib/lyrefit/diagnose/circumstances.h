#pragma once

#include <string>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/model/effect.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

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
