#pragma once

// The public header of the studies, lyrefit::study, a library on top of lyrefit::lyrefit: what repeated fits
// say together. Compare runs searches, yours as well, against each other on measured curves or on
// made ones with many local optima (MakeLandscape). Audit checks published parameters. Coverage counts
// how often the intervals of joint fits hold the truth, and CompareTruth holds a fit against
// parameters that are known. As in lyrefit.h nothing throws or prints.

#include "lyrefit/study/audit.h"
#include "lyrefit/study/compare.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/coverage.h"
#include "lyrefit/study/landscape.h"
#include "lyrefit/study/report/audit_csv.h"
#include "lyrefit/study/report/audit_json.h"
#include "lyrefit/study/report/compare_csv.h"
#include "lyrefit/study/report/compare_json.h"
#include "lyrefit/study/report/compare_plot.h"
#include "lyrefit/study/report/coverage_json.h"
#include "lyrefit/study/report/documents.h"
#include "lyrefit/study/truth.h"
