#include "plant/campaign_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace lyrefit {
namespace {

// What a mechanism is called, may come from, and what to do about it: of a loss and of a gain.
struct MechanismWords {
  Mechanism mechanism;
  const char* name;        // in a list
  const char* candidates;  // of a loss
  const char* what;        // of a loss; the size follows
  const char* action;      // of a loss
  const char* gained_candidates;
  const char* gained;
};

constexpr char kNote[] = "Note what was done to the string.";
constexpr char kMeasureTemperature[] =
    "Repeat the sweep with a temperature sensor behind a module of the string.";

constexpr char kOtherLight[] =
    "Sweep again at another light: resistance costs more in strong light, shunts in weak.";

constexpr MechanismWords kWords[] = {
    {Mechanism::kLight, "less light", "soiling shading sensor_offset",
     "less current, the rest as before: dirt or shade on all modules alike, or a sensor that "
     "read more light than there was; one sweep does not tell which",
     "Look for dirt and shade; if there is none, repeat the sweep with the sensor beside the "
     "modules.",
     "cleaning sensor_offset",
     "more current, the rest as before: cleaned modules, or a sensor that read less light than "
     "there was"},
    {Mechanism::kSubstrings, "substrings without voltage", "bypass_short missing_module",
     "the voltage of whole groups of cells is missing, the rest as before: shorted bypass diodes "
     "or a module less",
     "Count the modules of the string, then measure the voltage of each.", "repair",
     "the voltage of whole groups of cells came back"},
    {Mechanism::kTemperature, "temperature", "temp_offset",
     "less voltage, the rest as before: warmer cells than stated, which costs nothing at standard "
     "conditions",
     kMeasureTemperature, "temp_offset",
     "more voltage, the rest as before: cooler cells than stated, or than in the earlier sweep"},
    {Mechanism::kSeriesResistance, "series resistance", "series_resistance",
     "series resistance grew, of a connector, a cable, a junction box or of the contacts of cells",
     "Look at connectors and junction boxes under load with an infrared camera.", "repair",
     "series resistance fell"},
    {Mechanism::kShunt, "shunts", "shunt",
     "cells leak more than before: potential-induced degradation, or damaged cells",
     "Sweep the modules one by one at low light, from the negative end of the string: leaks cost "
     "most there. Look at the earthing of the inverter.",
     "repair", "cells leak less than before"},
    {Mechanism::kMismatch, "shade or mismatch", "shading mismatch",
     "a part of the cells has less light than the others: shade, uneven dirt, broken cells or "
     "weaker modules",
     "Look for shade and uneven dirt; then sweep the modules one by one.", "repair cleaning",
     "shade, uneven dirt or weak modules went"},
    {Mechanism::kOtherModules, "other modules", "other_module",
     "current, voltage and fill factor fell together, as with modules of another type",
     "Look at the labels of the modules; then sweep them one by one.", "other_module",
     "current, voltage and fill factor changed together, as with new modules"}};

const MechanismWords& WordsOf(const MechanismFit& fit) {
  return *std::find_if(std::begin(kWords), std::end(kWords),
                       [&](const MechanismWords& one) { return one.mechanism == fit.mechanism; });
}
static_assert(std::size(kWords) == kMechanisms, "every mechanism has words");

// Mechanisms that are likely enough to be named. Light does not change the voltage as other modules
// do, which are in question only where it changed.
std::vector<MechanismFit> LikelyOf(const CampaignChange& change) {
  constexpr double kLeast = 0.05;
  std::vector<MechanismFit> likely;
  for (const MechanismFit& fit : change.fits) {
    const bool voltage = fit.mechanism == Mechanism::kOtherModules &&
                         change.fits.front().mechanism == Mechanism::kLight;
    if (likely.empty() || voltage || fit.probability >= kLeast) likely.push_back(fit);
  }
  return likely;
}

// ", about 1.2 ohm": the size of what was lost or came back.
std::string SizeText(const CampaignChange& change, const CampaignString& before,
                     const CampaignString& after) {
  const MechanismFit& fit = change.fits.front();
  const auto& sound = change.gain ? after.values : before.values;
  switch (fit.mechanism) {
    case Mechanism::kLight:
      return fmt::format(", about {:.0f} %", 100 * fit.size);
    case Mechanism::kSubstrings:
      return fit.count > 0 ? fmt::format(", {} of {}", fit.count, after.bypass_diodes)
                           : fmt::format(", about {:.1f} % of it", 100 * fit.size);
    case Mechanism::kSeriesResistance:
      return fmt::format(", about {:.2g} ohm", fit.size * sound[kCVoc] / sound[kCIsc]);
    case Mechanism::kMismatch:
      return fmt::format(", about {:.0f} % of the cells with about {:.0f} % less",
                         std::fmax(100 * fit.part, 1), 100 * fit.size);
    case Mechanism::kTemperature:
    case Mechanism::kShunt:
    case Mechanism::kOtherModules:
      break;
  }
  return "";
}

// "Isc -2.1 %, FF +0.3 %" of the figures.
std::string FiguresText(const CampaignChange& change) {
  std::string text;
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    const int place = static_cast<int>(q);
    text += fmt::format("{}{} {:+.2f} % [{:+.2f}, {:+.2f}]", text.empty() ? "" : ", ",
                        kCampaignFigures[q], Percent(change.own[q]),
                        Percent(change.own[q] - Half95(change, place)),
                        Percent(change.own[q] + Half95(change, place)));
  }
  if (change.adjusted) {
    const double half = Half95(change, kAdjustedFill);
    text += fmt::format(
        ", FF adjusted {:+.2f} % [{:+.2f}, {:+.2f}]", Percent(change.own[kAdjustedFill]),
        Percent(change.own[kAdjustedFill] - half), Percent(change.own[kAdjustedFill] + half));
  }
  return text;
}

// "; or exchanged with A or B, whose change is the opposite"
std::string MaybeText(const CampaignChange& change, const std::vector<CampaignString>& after) {
  std::string names;
  for (const std::int32_t other : change.maybe) {
    names += (names.empty() ? "" : " or ") + after[other].id;
  }
  return names.empty() ? "" : "; or exchanged with " + names + ", whose figures changed places";
}

void AppendNew(const std::string& id, std::vector<std::string>* ids) {
  if (std::find(ids->begin(), ids->end(), id) == ids->end()) ids->push_back(id);
}

}  // namespace

std::vector<std::string> IdsIn(const std::string& words) {
  std::vector<std::string> ids;
  std::istringstream text(words);
  for (std::string id; text >> id;) ids.push_back(id);
  return ids;
}

double Percent(double logarithm) { return 100 * std::expm1(logarithm); }

double Half95(const CampaignChange& change, int q) { return change.t95 * change.sigma[q]; }

bool HasChange(const CampaignChange& change) {
  return change.before >= 0 && change.why_not.empty();
}

Cause CauseOf(const Campaign& campaign, const std::vector<CampaignString>& before,
              const std::vector<CampaignString>& after, std::size_t i) {
  const CampaignChange& change = campaign.changes[i];
  Cause cause;
  cause.id = change.kind == CampaignKind::kNotCompared ? "" : ToText(change.kind);
  cause.recoverable_power_W = {change.lost_W, change.lost_low_W, change.lost_high_W};
  switch (change.kind) {
    case CampaignKind::kNotCompared:
      cause.sentence = "not compared: " + change.why_not;
      return cause;
    case CampaignKind::kNone:
      cause.sentence = "no change beyond what is usual: " + FiguresText(change);
      return cause;
    case CampaignKind::kNew:
      cause.sentence = "the earlier results have no string of this name";
      return cause;
    case CampaignKind::kRenamed:
      cause.sentence =
          fmt::format("may be {} under another name: its figures agree, and that name is gone",
                      before[change.partner].id);
      cause.equivalents = {"renamed", "new"};
      cause.action = "Compare the plan of the plant.";
      return cause;
    case CampaignKind::kExchanged:
      cause.sentence = fmt::format(
          "has the earlier figures of {}, and that one those of this: exchanged "
          "names or cables; else one was repaired and the other failed alike. {}",
          after[change.partner].id, FiguresText(change));
      cause.equivalents = {"exchanged"};
      cause.action = "Compare labels and cables of both with the plan.";
      return cause;
    case CampaignKind::kMeasurement:
      cause.sentence =
          fmt::format("differs, but the light or the conditions changed during {} sweep: {}",
                      after[i].repeat ? "this" : "the earlier", FiguresText(change));
      if (after[i].repeat) cause.action = "Repeat the sweep.";
      return cause;
    default:
      break;
  }
  const std::vector<MechanismFit> likely = LikelyOf(change);
  const MechanismWords& words = WordsOf(likely.front());
  cause.probability = likely.front().probability;
  cause.action = change.gain ? kNote : words.action;
  std::string set;
  for (const MechanismFit& fit : likely) {
    const MechanismWords& one = WordsOf(fit);
    for (const std::string& id : IdsIn(change.gain ? one.gained_candidates : one.candidates)) {
      AppendNew(id, &cause.equivalents);
    }
    set += fmt::format("{}{} ({:.0f} %)", set.empty() ? "" : ", ", one.name, 100 * fit.probability);
    cause.alternatives.push_back({ToText(KindOf(fit.mechanism)), one.name, fit.probability});
  }
  if (change.fits.front().count == 1 && likely.size() == 1 && !change.gain) {
    cause.equivalents = {"bypass_short"};
  }
  const bool several = change.kind == CampaignKind::kSeveral;
  if (!several && (likely.size() == 1 || likely.front().probability >= kSureOfMechanism)) {
    cause.sentence = (change.gain ? words.gained : words.what) +
                     SizeText(change, before[change.before], after[i]);
  } else {
    const bool poor = several && likely.front().probability >= kSureOfMechanism;
    cause.sentence = fmt::format("{} power; {}: {}", change.gain ? "more" : "less",
                                 poor ? "several causes or one that is not known, the nearest is"
                                      : "the two sweeps do not tell which",
                                 set);
    const bool voltage = change.kind == CampaignKind::kVoltage;
    cause.separate_by = {voltage ? kMeasureTemperature : kOtherLight};
    if (!change.gain) cause.action = cause.separate_by.front();
  }
  if (!change.maybe.empty()) cause.equivalents.emplace_back("exchanged");
  const std::string& own = after[i].cause;
  const bool shown = !change.gain && !own.empty() && own != before[change.before].cause;
  cause.sentence +=
      fmt::format("{}{}: {}", MaybeText(change, after),
                  shown ? "; the sweep itself shows " + own : "", FiguresText(change));
  return cause;
}

// What a shift of all strings may come from.
std::string CommonSentence(const CampaignGroup& group, const char* whose) {
  std::string text;
  for (std::size_t q = 0; q < kCampaignFigures.size(); ++q) {
    text += fmt::format("{}{} {:+.2f} %", text.empty() ? "" : ", ", kCampaignFigures[q],
                        Percent(group.shift[q]));
  }
  return fmt::format(
      "{}: {}. Current and power: light (dirt, shade, age of all modules) or the light sensor; "
      "voltage: temperature sensor or age. Nothing in these sweeps decides between both",
      whose, text);
}

}  // namespace lyrefit
