#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit::python {

// Row of one fit in a frame. Names are pvlib's: photocurrent, ..., nNsVth, i_sc, v_oc, p_mp.
struct FitRow {
  std::string id;
  std::string status;  // as in the results of a batch: "fine", "not usable", "broken"
  std::string reason;  // of a status other than "fine"
  std::string model;
  std::string warnings;
  std::vector<std::string> parameters;    // in the order of the model
  std::map<std::string, double> numbers;  // without unknown ones
};

FitRow RowOf(const std::string& id, const FitReport& report);
FitRow BrokenRow(const std::string& id, const Error& error);

// A pandas.DataFrame with one row for each fit, in their order. Columns: id, status, reason, model,
// the conditions, the parameters of the largest model, each followed by its standard error, key
// points of the model, RMSEs under both labels, warnings. Unknown values are NaN.
pybind11::object FrameOf(const std::vector<FitRow>& rows);

}  // namespace lyrefit::python
