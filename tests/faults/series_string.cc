#include "faults/series_string.h"

#include <algorithm>
#include <cmath>

#include "faults/root.h"

namespace faults {
namespace {

constexpr double kBypassSlope = 0.031;  // V, n kT/q of a warm bypass diode

double CellsVoltage(const Substring& part, double current) {
  double voltage = 0;
  for (const CellGroup& group : part.groups) {
    voltage += group.count * CellVoltage(group.cell, current);
  }
  return voltage;
}

double BypassCurrent(const Substring& part, double voltage) {
  const double saturation = part.drop_current / std::expm1(part.drop / kBypassSlope);
  return saturation * std::expm1(std::min(-voltage / kBypassSlope, 300.0));
}

double SubstringVoltage(const Substring& part, double current) {
  const double open = CellsVoltage(part, current);
  if (!part.bypassed || open > 0) return open;
  if (part.ideal) return std::max(open, -part.drop);
  const auto surplus = [&](double through_cells) {
    return through_cells + BypassCurrent(part, CellsVoltage(part, through_cells)) - current;
  };
  const double most = std::min(current, part.groups.front().cell.photocurrent);
  return CellsVoltage(part, Root(surplus, most, 0.01 * part.drop_current));
}

}  // namespace

double StringCurrent(const std::vector<Substring>& string, double voltage) {
  const auto missing = [&](double current) {
    double sum = 0;
    for (const Substring& part : string) sum += part.copies * SubstringVoltage(part, current);
    return voltage - sum;
  };
  const double guess = string.front().groups.front().cell.photocurrent;
  return Root(missing, guess, 0.02 * string.front().drop_current);
}

}  // namespace faults
