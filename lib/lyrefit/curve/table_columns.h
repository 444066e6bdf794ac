#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/column.h"
#include "lyrefit/curve/read_curve.h"

namespace lyrefit {

// A voltage and a current that belong together, by their places among the columns.
struct Channel {
  int voltage;
  int current;
};

// The place of the column that somebody called by its name (in any case) or its place from 1.
std::optional<int> FindColumn(const std::vector<Column>& columns, const std::string& wish);

// Gives the columns that the options name the kind they are said to have; others of that kind are
// not used then. Names that are not there change nothing.
void ApplyColumnWishes(const ReadOptions& options, std::vector<Column>* columns);

// Gives the voltage and the current of a channel the units that the options name.
Expected<void> ApplyUnitWishes(const ReadOptions& options, const Channel& channel,
                               std::vector<Column>* columns);

// Where the names tell no voltage and current: the only pair of a letter and a common suffix
// ("Vx", "Ix"), else the only columns in volt and in ampere. False if there is no such thing.
bool GuessColumns(std::vector<Column>* columns);

// All pairs: every current over the only voltage, or as many voltages as currents, by their numbers
// or in their order. Densities count where there is no current. Empty if nothing fits.
std::vector<Channel> FindChannels(const std::vector<Column>& columns);

// The channel that `wish` names; without a wish the only one. The error lists them.
Expected<Channel> ChooseChannel(const std::vector<Column>& columns,
                                const std::vector<Channel>& channels, const std::string& wish);

// "1 'Current 1 (A)', 2 'Current 2 (A)'".
std::string ListChannels(const std::vector<Column>& columns, const std::vector<Channel>& channels);

}  // namespace lyrefit
