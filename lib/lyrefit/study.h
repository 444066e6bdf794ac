// Experimental: may change in a minor version (data/stable).
#pragma once

// Public header of lyrefit::study, a library on top of lyrefit::lyrefit that evaluates repeated
// fits. Compare runs search algorithms, including a caller's own, on measured curves. Audit checks
// published parameters. As in lyrefit.h nothing throws or prints.

#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/compare.h"
#include "lyrefit/study/report/documents.h"
