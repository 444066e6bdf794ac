#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {

// A voltage column and the current column that belongs to it, by position.
struct ColumnPair {
  int voltage;
  int current;
};

// The columns of one measurement: a pair, and the pairs of its further sweeps in order.
struct Channel : ColumnPair {
  std::vector<ColumnPair> more = {};

  Channel(int voltage, int current) : ColumnPair{voltage, current} {}
};

// Position of the column with the name `wish` (ignoring case) or the place `wish` (from 1).
std::optional<int> FindColumn(const std::vector<Column>& columns, const std::string& wish);

// Declares the columns that the options name as voltage and current. Other columns of these kinds
// are no longer used. Names that no column has change nothing.
void ApplyColumnWishes(const ReadOptions& options, std::vector<Column>* columns);

// Sets the units of a channel's columns to those that the options name. Error: an unknown unit.
Expected<void> ApplyUnitWishes(const ReadOptions& options, const Channel& channel,
                               std::vector<Column>* columns);

// All channels. One voltage is paired with every current; several are paired with as many currents
// by tag, else by order. Current densities are used if there is no current, and averages if there
// is no other column. Pairs of one device and light in several directions are one channel, as are
// two columns whose average is a third. Empty if no pairing works.
std::vector<Channel> FindChannels(const std::vector<Column>& columns);

// The place of the channel measured under load beside a Suns-Voc trace and perhaps a dark curve;
// nullopt without a trace, or if there is not exactly one.
std::optional<std::size_t> ChannelUnderLoad(const std::vector<Column>& columns,
                                            const std::vector<Channel>& channels);

// Whether the light in a column is that of a Suns-Voc trace: it follows the trace's columns.
bool IsLightOfTrace(const std::vector<Column>& columns, int light);

// The channel that `wish` names; if `wish` is empty the only channel, or the one under load beside a
// Suns-Voc trace. The error lists all channels.
Expected<Channel> ChooseChannel(const std::vector<Column>& columns,
                                const std::vector<Channel>& channels, const std::string& wish);

// Name of a channel: the label of its current; of several sweeps, and where a letter
// states the light, the device and the light.
std::string ChannelName(const std::vector<Column>& columns, const Channel& channel);

// The channels as text: "1 'Current 1 (A)', 2 'Current 2 (A)'".
std::string ListChannels(const std::vector<Column>& columns, const std::vector<Channel>& channels);

}  // namespace lyrefit
