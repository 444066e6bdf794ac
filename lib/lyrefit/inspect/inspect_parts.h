#pragma once

#include <string>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/inspect/inspect.h"
#include "lyrefit/read/table_view.h"
#include "lyrefit/read/text_encoding.h"

namespace lyrefit {

// A file that was read once, and what is found in it.
struct Inspected {
  const std::string& path;
  const ReadOptions& options;  // without a choice among curves
  const DecodedText& text;
  Inspection* found;
};

// The curves of the text, as ReadMeasurement reads them from a file.
Expected<CurveSet> CurvesIn(const Inspected& file, const ReadOptions& options);

// Describes the columns and the lines above them, of a table.
void TakeTable(const Inspected& file);

// Describes the curves, what they lack and what may be run; with whatever flags would make them
// readable where they are refused.
void TakeCurves(const Inspected& file);
void DescribeCurves(const CurveSet& set, Inspection* found);

// The parameters and data sheets of modules of other programs. False: the text is none.
bool TakeModule(const Inspected& file);

// Many curves of one row each, or of a long table. False: the text holds none.
bool TakeManyCurves(const Inspected& file);

void TakeFolder(const std::string& path, const ReadOptions& options, Inspection* found);

}  // namespace lyrefit
