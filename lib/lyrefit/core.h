#pragma once

// The core alone: a measured curve, the models, searches, and the fit of one curve with its
// uncertainties. It reads no files and writes no reports; lyrefit.h has those too.
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/search/search.h"
