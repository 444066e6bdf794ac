#include "lyrefit/read/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <utility>

#include "lyrefit/curve/dark.h"
#include "lyrefit/read/column.h"

namespace lyrefit {
namespace {

bool IsLitCurve(const IvCurve& curve) { return !curve.suns_voc_A && !IsStatedDark(curve); }

// Moves the brightest lit curve, of equals the first, to the front.
void PutBrightestFirst(std::vector<IvCurve>* curves) {
  const auto light = [](const IvCurve& curve) {
    return IsLitCurve(curve) ? curve.conditions.irradiance_W_m2 : -1;
  };
  const auto brightest =
      std::max_element(curves->begin(), curves->end(),
                       [&](const IvCurve& a, const IvCurve& b) { return light(a) < light(b); });
  std::rotate(curves->begin(), brightest, brightest + 1);
}

}  // namespace

bool HoldsSeveralCells(const CurveSet& set, UnstatedDark unstated) {
  constexpr double kSameLight = 0.02;
  std::vector<const IvCurve*> seen;
  for (const IvCurve& curve : set.curves) {
    if (!curve.irradiance_W_m2.empty() || !IsLitCurve(curve)) continue;
    if (unstated == UnstatedDark::kDark && IsDark(curve)) continue;
    const double light = curve.conditions.irradiance_W_m2;
    const bool same = std::any_of(seen.begin(), seen.end(), [&](const IvCurve* other) {
      return other->source == curve.source &&
             std::fabs(other->conditions.irradiance_W_m2 - light) <= kSameLight * light;
    });
    if (same) return true;
    seen.push_back(&curve);
  }
  return false;
}

std::string CellOfCurve(const std::string& name) {
  const Column column = RecogniseColumn(name);
  const bool current =
      column.kind == ColumnKind::kCurrent || column.kind == ColumnKind::kCurrentDensity;
  // A name without a quantity may look like one: the pixel "a" like the unit of a current.
  const ColumnTag tag = current && !column.tag.device.empty() ? column.tag : ReadTag(name);
  return tag.device.empty() && !StatesSweep(tag) ? name : tag.device;
}

std::vector<CellCurves> SplitIntoCells(CurveSet set) {
  std::vector<CellCurves> cells;
  const bool several = HoldsSeveralCells(set, UnstatedDark::kDead);
  for (IvCurve& curve : set.curves) {
    const std::string name = CellOfCurve(curve.name);
    auto cell = std::find_if(cells.begin(), cells.end(), [&](const CellCurves& other) {
      return !several || other.name == name;
    });
    if (cell == cells.end()) cell = cells.insert(cells.end(), {name, {}});
    cell->curves.push_back(std::move(curve));
  }
  for (CellCurves& cell : cells) PutBrightestFirst(&cell.curves);
  return cells;
}

Expected<void> CheckIsOneCell(const CurveSet& set, const char* each) {
  if (!set.several_devices && !HoldsSeveralCells(set, UnstatedDark::kDark)) return {};
  std::string names;
  const auto add = [&names](const std::string& name) {
    names += (names.empty() ? "" : ", ") + name;
  };
  if (set.several_devices) {
    for (const IvCurve& curve : set.curves) add(curve.name);
  } else {
    for (const CellCurves& one : SplitIntoCells(set)) add(one.name);
  }
  return Fail(fmt::format("this file holds several cells ({}): choose one with --column NAME, or "
                          "take each with lyrefit {}",
                          names, each),
              set.curves.front().source);
}

std::string SampleOfCell(const std::string& id, const std::string& where) {
  static const std::regex kPixel(
      "(.*?)(?:^|[_. -]+)(?:(?:px|pix|pixel|p|cell|dev)[_. -]?)?(?:[a-z]|[0-9]{1,2})",
      std::regex::icase);
  const std::size_t slash = id.rfind('/');
  const std::string above = slash == std::string::npos ? "" : id.substr(0, slash);
  const std::string leaf = slash == std::string::npos ? id : id.substr(slash + 1);
  constexpr std::size_t kLongest = 200;  // of a level that is looked at
  std::smatch match;
  const bool pixel = leaf.size() <= kLongest && std::regex_match(leaf, match, kPixel);
  if (pixel && match[1].length() > 0) return id.substr(0, id.size() - leaf.size()) + match[1].str();
  const bool whole_file = !pixel && std::filesystem::path(where).stem().string() == leaf;
  return above.empty() || whole_file ? id : above;
}

}  // namespace lyrefit
