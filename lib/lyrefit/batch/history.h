// Experimental: may change in a minor version (data/stable).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/batch_options.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/stream/batch_source.h"

namespace LYREFIT_PUBLIC lyrefit {

// Reference sweeps of every string by its id, for comparison with its history. They are kept in
// memory, about 16 bytes a reading. This memory grows with the number of sweeps, unlike that of
// other tasks.
class ReferenceSweeps;

// Reads all sweeps and applies `prepare` to each, as to the curves of the run. A sweep belongs to
// the string with its id ("inv/comb/str7"). If each string has a folder, it belongs to the level
// above ("inv/comb/str7/2025-06-01"). Errors: no readable sweep.
Expected<std::shared_ptr<const ReferenceSweeps>> ReadReferences(
    BatchSource* source, const std::function<Expected<void>(IvCurve*)>& prepare);

// Adds a comparison with the reference sweeps of the same id to a task. The columns history_sweeps,
// history_p, history_cause and history_sentence follow those of the task. They hold the result of
// CompareWithReferences, or the reason why there is no comparison. `options` of the task gets the
// digest of the sweeps.
BatchTaskType WithHistory(BatchTaskType task, std::shared_ptr<const ReferenceSweeps> sweeps,
                          const ReferenceOptions& asked);

}  // namespace lyrefit
