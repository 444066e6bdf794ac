#include "plant/campaign_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lyrefit {
namespace {

// What a kind may come from, and what to do: for a loss and for a gain. Candidates are ids of
// effects, and missing_module, other_module, dirt_removed, repair.
struct KindWords {
  CampaignKind kind;
  const char* candidates;
  const char* what;    // of a loss
  const char* action;  // of a loss
  const char* gained_candidates;
  const char* gained;
};

constexpr char kNote[] = "Note what was done to the string; nothing else to do.";

constexpr KindWords kKindWords[] = {
    {CampaignKind::kLight, "soiling shading sensor_offset",
     "less current, the rest as before: dirt or shade on all modules alike, or a sensor that "
     "read more light than there was; one sweep does not tell which",
     "Look for dirt and shade; if there is none, repeat the sweep with the sensor beside the "
     "modules.",
     "cleaning sensor_offset",
     "more current, the rest as before: cleaned modules, or a sensor that read less light than "
     "there was"},
    {CampaignKind::kSubstrings, "bypass_short missing_module",
     "the voltage of whole groups of cells is missing, the rest as before",
     "Count the modules of the string, then measure the voltage of each.", "repair",
     "the voltage of whole groups of cells came back"},
    {CampaignKind::kVoltage, "bypass_short missing_module temperature_or_cells temp_offset",
     "less voltage, the rest as before: warmer cells than stated, or cells that are bypassed or "
     "degraded",
     "Repeat the sweep with a temperature sensor behind a module of the string.",
     "temperature_or_cells temp_offset repair",
     "more voltage, the rest as before: cooler cells than stated, or a repair"},
    {CampaignKind::kSeriesResistance, "series_resistance",
     "the voltage at maximum power fell: series resistance grew, of a connector, a cable or a "
     "junction box",
     "Look at connectors and junction boxes under load with an infrared camera.", "repair",
     "the voltage at maximum power rose: series resistance fell"},
    {CampaignKind::kShuntOrMismatch, "shunt mismatch shading",
     "the current at maximum power fell more than the short-circuit current: shunts, or modules "
     "that no longer match (shade, uneven dirt, another type, a cracked cell)",
     "Look for shade and uneven dirt; then sweep the modules one by one.", "repair cleaning",
     "the current at maximum power rose: shade, dirt or shunts went"},
    {CampaignKind::kFillFactor, "series_resistance shunt mismatch shading",
     "less fill factor: resistance, shunts or mismatch; the figures do not tell which",
     "Sweep again at another light: resistance costs more in strong light, shunts in weak.",
     "repair cleaning", "more fill factor"},
    {CampaignKind::kSeveral, "other_module mismatch shading shunt bypass_short soiling",
     "several figures fell at once", "Look at the string; then sweep its modules one by one.",
     "repair cleaning other_module", "several figures changed at once, with more power"},
    {CampaignKind::kPower, "soiling shading series_resistance sensor_offset",
     "less power, while no single figure fell by more than is usual", "Repeat the sweep.",
     "cleaning repair sensor_offset", "more power, while no single figure rose"},
};

const KindWords* WordsOf(CampaignKind kind) {
  for (const KindWords& words : kKindWords) {
    if (words.kind == kind) return &words;
  }
  return nullptr;
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

std::string StepText(const CampaignChange& change, const CampaignString& after) {
  if (change.kind != CampaignKind::kSubstrings) return "";
  const int one = std::abs(change.steps_low), other = std::abs(change.steps_high);
  const int least = std::min(one, other), most = std::max(one, other);
  return fmt::format("; of {} bypass diodes {} {} of these groups", after.bypass_diodes,
                     least == most ? std::to_string(least) : fmt::format("{} to {}", least, most),
                     most == 1 ? "has one" : "have one each");
}

// "; or exchanged with A or B, whose change is the opposite"
std::string MaybeText(const CampaignChange& change, const std::vector<CampaignString>& after) {
  std::string names;
  for (const std::int32_t other : change.maybe) {
    names += (names.empty() ? "" : " or ") + after[other].id;
  }
  return names.empty() ? "" : "; or exchanged with " + names + ", whose figures changed places";
}

}  // namespace

double Percent(double logarithm) { return 100 * std::expm1(logarithm); }

double Half95(const CampaignChange& change, int q) { return change.t95 * change.sigma[q]; }

bool HasChange(const CampaignChange& change) {
  return change.before >= 0 && change.why_not.empty();
}

ChangeTexts TextsOf(const Campaign& campaign, const std::vector<CampaignString>& before,
                    const std::vector<CampaignString>& after, std::size_t i) {
  const CampaignChange& change = campaign.changes[i];
  switch (change.kind) {
    case CampaignKind::kNotCompared:
      return {"not compared: " + change.why_not, "", ""};
    case CampaignKind::kNone:
      return {"no change beyond what is usual: " + FiguresText(change), "", ""};
    case CampaignKind::kNew:
      return {"the earlier results have no string of this name", "", ""};
    case CampaignKind::kRenamed:
      return {fmt::format("may be {} under another name: its figures agree, and that name is gone",
                          before[change.partner].id),
              "renamed new", "Compare the plan of the plant."};
    case CampaignKind::kExchanged:
      return {fmt::format("has the earlier figures of {}, and that one those of this: exchanged "
                          "names or cables; else one was repaired and the other failed alike. {}",
                          after[change.partner].id, FiguresText(change)),
              "exchanged", "Compare labels and cables of both with the plan."};
    case CampaignKind::kMeasurement:
      return {fmt::format("differs, but the light or the conditions changed during {} sweep: {}",
                          after[i].repeat ? "this" : "the earlier", FiguresText(change)),
              "", after[i].repeat ? "Repeat the sweep." : ""};
    default:
      break;
  }
  const KindWords& words = *WordsOf(change.kind);
  const bool loss = change.lost_W > 0;
  const bool cause = loss && !after[i].cause.empty() &&
                     after[i].cause != before[change.before].cause &&
                     change.kind != CampaignKind::kLight;
  ChangeTexts texts;
  texts.sentence =
      fmt::format("{}{}{}: {}", loss ? words.what : words.gained,
                  StepText(change, after[i]) + MaybeText(change, after),
                  cause ? "; the sweep itself shows " + after[i].cause : "", FiguresText(change));
  texts.candidates = cause ? after[i].cause : loss ? words.candidates : words.gained_candidates;
  if (change.steps_high == 1 && loss) texts.candidates = "bypass_short";
  if (!change.maybe.empty()) texts.candidates += " exchanged";
  texts.action = loss ? words.action : kNote;
  return texts;
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
