#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/table_columns.h"

namespace lyrefit {

// One result that a head states, such as Voc, with a value for each sweep or cell.
struct ResultLine {
  std::string label;               // as in the file, with its unit: "Jsc [mA/cm2]"
  std::vector<std::string> names;  // of the columns that the values belong to; may be empty
  std::vector<double> values;      // NaN where there is no number
  std::string source;              // "line 7 'Jsc [mA/cm2]: -20.1'"
};

// The name of a result without its unit, in small letters: "jsc" of "JSC [mA/cm2]".
std::string ResultName(std::string_view label);
// Its unit in small letters, letters and digits only: "macm2"; empty if it names none.
std::string ResultUnit(std::string_view label);

// Whether a name is that of a result or a rated value: a key point, fill factor, efficiency, a
// resistance.
bool IsResult(std::string_view label);

// Whether the names are key points such as Isc and Voc, with or without units.
bool AreKeyPoints(const std::vector<std::string>& names);

// Replaces `names` by those of a line "\ta_Forward\ta_Reverse" or "Parameter\tb_rev\tb_for", to
// which the values of the lines below it belong; by none that ends the line. Other lines change
// nothing.
void TakeColumnNames(std::string_view line, std::vector<std::string>* names);

// The values of a line "label: value value ..." of a head. `names` are the fields of the last line
// above that named columns, from the second on; they are kept if there are as many as values.
ResultLine ReadResultLine(std::string_view line, const std::vector<std::string>& names,
                          const std::string& source);

// The results of one measurement, for its sweeps in order. A value belongs to the column of its
// name, else to the current column of its place if there are as many values as current columns, else
// to the only sweep. Others are left out.
std::vector<StatedResult> ResultsOf(const std::vector<ResultLine>& lines,
                                    const std::vector<Column>& columns,
                                    const std::vector<Channel>& channels, const Channel& channel);

// The id of the element `key` inside the element `id` of a JSON document: "sample.jv".
std::string MemberId(const std::string& id, const std::string& key);

// Whether a JSON object holds nothing but scalars, such as the settings beside the readings.
bool HoldsScalarsOnly(const nlohmann::json& object);

// The results that a JSON object of this id, or an object of scalars in it, states.
std::vector<StatedResult> ResultsIn(const nlohmann::json& object, const std::string& id);

}  // namespace lyrefit
