#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/fit/fit_report.h"

namespace lyrefit::python {

// What a frame says of one fit. Names are pvlib's: photocurrent, ..., nNsVth, i_sc, v_oc, p_mp.
struct FitRow {
  std::string id;
  std::string status;  // as in the rows of a batch: "fine", "not usable", "broken"
  std::string reason;  // why it is not fine
  std::string model;
  std::string warnings;
  std::vector<std::string> parameters;    // in the order of the model
  std::map<std::string, double> numbers;  // those that are known
};

FitRow RowOf(const std::string& id, const FitReport& report);
FitRow BrokenRow(const std::string& id, const Error& error);

// A pandas.DataFrame with a row each, in their order: id, status, reason, model, the conditions, the
// parameters of the largest model, each followed by its standard error, key points of the model,
// RMSEs under both labels, warnings. NaN stands for what is not known.
pybind11::object FrameOf(const std::vector<FitRow>& rows);

}  // namespace lyrefit::python
