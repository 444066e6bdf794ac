#pragma once

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/label.h"
#include "lyrefit/read/table_head.h"

namespace lyrefit {

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
