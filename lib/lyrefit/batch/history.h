#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/diagnose/reference_options.h"
#include "lyrefit/batch/batch_options.h"
#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/batch_task.h"

namespace LYREFIT_PUBLIC lyrefit {

// Strings against their own history: reference sweeps of every string, by their ids. They are kept in
// memory, about 16 bytes a reading: what grows is this, not what is done with many curves.
class ReferenceSweeps;

// Reads all of them, each with `prepare` as the curves of the run. A sweep belongs to the string of
// its id ("inv/comb/str7") or, in a folder a string, of the level above ("inv/comb/str7/2025-06-01").
// Errors: no sweep that can be read.
Expected<std::shared_ptr<const ReferenceSweeps>> ReadReferences(
    BatchSource* source, const std::function<Expected<void>(IvCurve*)>& prepare);

// The task and, behind its columns, what CompareWithReferences says of each curve and the sweeps of its
// own id: history_sweeps, history_p, history_cause, history_sentence (or why there is no comparison). `options`
// echoes the digest of the sweeps.
BatchTaskType WithHistory(BatchTaskType task, std::shared_ptr<const ReferenceSweeps> sweeps,
                   const ReferenceOptions& asked);

}  // namespace lyrefit
