#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/column.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/stated_results.h"

namespace lyrefit {

// A short-circuit current stated in the head of a table. It identifies the unit of a current column
// that names none.
struct StatedCurrent {
  double value;     // in the stated unit
  ColumnKind kind;  // a current or a current density
  double factor;    // converts to A or A/cm2
  std::string source;
};

// Statements in the lines before the header of a table.
struct TableHead {
  Sidecar said;
  std::vector<Assumption> assumptions;    // values taken, with their source
  std::vector<std::string> results;       // lines that state a result, such as Voc or efficiency
  std::vector<ResultLine> result_lines;   // their values
  std::vector<std::string> column_names;  // fields of the last line that begins a block of results
  std::vector<std::string> left;          // other lines with a number that was not understood
  std::vector<std::string> left_temperatures;  // lines that may state the device's temperature
  std::optional<StatedCurrent> short_circuit;
  std::optional<int> module_cells;  // cells in series of one module
  std::string module_cells_in;      // where that is stated: "line 4"
};

enum class HeadLine {
  kText,
  kComment  // only a clear statement counts; other text is a remark
};

// Records the statements of a line: irradiance, cell temperature, number of cells, modules in series,
// cells per module, bypass diodes, area, compliance, date, technology. Examples: "Irradiance (W/m2),912", "POA 912 W/m2", "Number of
// cells: 60". The first of two statements about one quantity is kept.
void ReadHeadLine(std::string_view text, int number, HeadLine kind, TableHead* head);

// Records what words say of the light: the dark, or that of a room, of which no irradiance is known.
// A stated irradiance that cannot be that of the words gives way. False if they say nothing of it.
bool TakeLight(std::string_view words, const std::string& source, TableHead* head);

// Records a named value, as JSON files state it. False if it was not understood.
bool TakeStatement(std::string_view label, double value, const std::string& source,
                   TableHead* head);

// Sentences about the head: the values taken, and some of the lines not understood.
std::vector<Assumption> HeadSentences(const TableHead& head);

// A statement of a head, "Irradiance: 912 W/m2": the words of its name, its unit and its value.
struct Statement {
  std::set<std::string> words;
  std::string name;  // the words, concatenated
  std::string unit;
  double value = 0;
};

// "line 9" of the source "line 9 'Cell temperature: 49.8 C'".
std::string PlaceOf(const std::string& source);

// Whether the name of the statement has one of these words.
bool HasAny(const Statement& statement, std::initializer_list<const char*> words);

// Splits a label into name and unit. The unit is the longest end of the label that is a unit: "Cell
// area (cm2)", "area_cm2".
// `unit`: that of the value; empty if only the label may have it.
Statement Understand(const std::vector<LabelWord>& words, double value, std::string_view unit);

// Records the value of a condition or of the device that a statement gives and that the head does not
// have yet, with an assumption that names `source`. False if it gives none.
bool TakeStatement(const Statement& statement, const std::string& source, TableHead* head);

// Whether a statement is "T = 50.2 C", of a temperature that it does not name.
bool IsBareTemperature(const Statement& statement);

// Records a bare temperature as that of the cells, if the line of `source` states the irradiance too.
bool TakeTemperatureBesideLight(const Statement& statement, const std::string& source,
                                TableHead* head);

// Whether words name the light of a room, which has no certain irradiance: "Room light", "indoor".
bool IsRoomLight(std::string_view text);

// Whether a label names the light: "Light source", "Illumination".
bool NamesLight(std::string_view label);

// Whether a line that was not understood may state the temperature of the device: a word of its label
// names one, and none another thing.
bool MayStateTemperature(std::string_view label);

}  // namespace lyrefit
