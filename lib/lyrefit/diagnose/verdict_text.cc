#include "lyrefit/diagnose/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "lyrefit/base/median.h"
#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

// Range of the lack of fit of a single diode on sweeps of modules without a fault, in fractions of
// Isc.
constexpr double kLeastHealthy = 5e-4, kMostHealthy = 2e-3;

constexpr double kLeastShown = 5e-5;  // of Isc

std::string OfIsc(double part) {
  if (part < kLeastShown) return "less than 0.01 % of Isc";
  return fmt::format("{:.2f} % of Isc", 100 * part);
}

// "0.05 to 0.20 %"
std::string Usual() {
  return fmt::format("{:.2f} to {:.2f} %", 100 * kLeastHealthy, 100 * kMostHealthy);
}

// "0.12 % of Isc, as healthy modules do (0.05 to 0.20 %)". `noise`: of the readings, in Isc.
std::string DepartureText(double lack_of_fit, double noise, const Floors& floors) {
  if (lack_of_fit < kLeastHealthy) {
    const std::string size =
        noise > kMostHealthy ? fmt::format(" of {:.1f} % of Isc", 100 * noise) : "";
    return OfIsc(lack_of_fit) + " beyond their noise" + size;
  }
  if (lack_of_fit <= kMostHealthy)
    return OfIsc(lack_of_fit) + ", as healthy modules do (" + Usual() + ")";
  return OfIsc(lack_of_fit) +
         fmt::format(", more than healthy modules do ({}) but less than the floor of {:g} %",
                     Usual(), 100 * floors.current);
}

// "a, b or c"
std::string Alternatives(const std::vector<std::string>& texts) {
  std::string text;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    if (k > 0) text += k + 1 < texts.size() ? ", " : " or ";
    text += texts[k];
  }
  return text;
}

// What is too small to act on, by the name of each that it may be.
std::string BelowText(const Verdict& verdict, const Floors& floors, double probability) {
  if (verdict.below_floor.empty()) return "";
  const Cause& cause = verdict.below_floor.front();
  std::vector<std::string> titles = {cause.title};
  for (const Alternative& one : SaidBeside(cause, probability)) titles.push_back(one.title);
  return fmt::format("present, but not certainly above {:g} % of Isc or {:g} % of Pmax: {}",
                     100 * floors.current, 100 * floors.power, Alternatives(titles));
}

// "One sweep", "These curves"
std::string Measured(int curves) { return curves > 1 ? "These curves" : "One sweep"; }

// "a leak of 3.1 % of Isc at Voc (-4 % of Pmax)"
std::string FindingText(const DeviceFinding& finding) {
  const double value = finding.value.value;
  std::string what =
      finding.id == "leak"          ? fmt::format("a leak of {:.1f} % of Isc at Voc", 100 * value)
      : finding.id == "fill_factor" ? fmt::format("a fill factor of {:.2f}", value)
      : finding.id == "ideality"    ? fmt::format("n = {:.2f}", value)
                                    : fmt::format("{:.1f} % of Voc lost across Rs", 100 * value);
  if (!std::isfinite(finding.power_loss)) return what;
  return fmt::format("{} ({:+.1f} % of Pmax)", what, -100 * finding.power_loss);
}

// "the sweep ends at 26 V, 8.42 A, before the point of maximum power"; empty if it does not.
std::string EarlyEnd(const Readings& readings) {
  constexpr double kLast = 0.98, kFallen = 0.5;  // of the largest voltage, of the largest current
  if (!readings.traits.single || readings.traits.only_dark) return "";
  const Reading *best = &readings.points.front(), *last = best;
  double largest = 0;
  for (const Reading& reading : readings.points) {
    if (reading.voltage * reading.current > best->voltage * best->current) best = &reading;
    if (reading.voltage > last->voltage) last = &reading;
    largest = std::max(largest, reading.current);
  }
  if (best->voltage < kLast * last->voltage || last->current < kFallen * largest) return "";
  return fmt::format("the sweep ends at {:.4g} V, {:.3g} A, before the point of maximum power",
                     last->voltage * readings.scale.cells,
                     last->current * readings.scale.current_A);
}

// Sentence if no cause is named: the lack of fit, effects below the floors, parameters of the
// device, and what the readings cannot show.
std::string NothingSentence(const Verdict& verdict, const Floors& floors,
                            const WeightedData& weighted,
                            const std::vector<DeviceFinding>& findings, double probability) {
  const int curves = weighted.readings->traits.curves;
  if (!floors.Any() && findings.empty()) {
    return "Nothing to find: what the base model leaves is noise.";
  }
  const double lack_of_fit = verdict.lack_of_fit.value;
  const std::string limits =
      verdict.not_shown.empty()
          ? "."
          : fmt::format(". {} cannot show {}.", Measured(curves), verdict.not_shown);
  std::string present = BelowText(verdict, floors, probability);
  if (MissesTooMuch(verdict, floors)) {
    present = present.empty() ? ", and no cause of the catalogue explains it" : "; " + present;
    return fmt::format(
        "The base model misses the data by {}, more than it misses healthy modules by ({}){}. To "
        "tell: {}{}{}",
        OfIsc(lack_of_fit), Usual(), present, curves > 1 ? "diagnose each curve by itself; " : "",
        FindEffect("unknown_structure")->separate_by, limits);
  }
  if (!findings.empty()) {
    const bool depends = std::all_of(findings.begin(), findings.end(),
                                     [](const DeviceFinding& one) { return one.if_silicon; });
    std::string text =
        depends ? "No single fault shows. Whether the device is healthy depends on its technology, "
                  "which nobody states (--technology); of silicon it would not be: "
                : "No single fault shows, but the device is not as healthy ones are: ";
    for (std::size_t k = 0; k < findings.size(); ++k) {
      text += (k > 0 ? ", " : "") + FindingText(findings[k]);
    }
    return text + (present.empty() ? "" : ". Also " + present) + limits;
  }
  if (const std::string end = EarlyEnd(*weighted.readings); !end.empty()) {
    return "It cannot be judged: " + end + ". To tell: a sweep to open circuit" + limits;
  }
  return "Nothing to act on: the data depart from the base model by " +
         DepartureText(lack_of_fit, UpperMedian(weighted.sigma), floors) +
         (present.empty() ? "" : "; " + present) + limits;
}

bool IsNameless(const Verdict& verdict) {
  return verdict.causes.size() == 1 && verdict.causes.front().id == "unknown_structure";
}

// The finding by its most probable mechanism, or by several where they belong to different parts, such
// as device and instrument, and none of them is probable enough alone.
std::vector<Alternative> SaidOf(const Cause& cause, double probability) {
  std::vector<Alternative> said = {{cause.effect, cause.title, cause.probability}};
  const std::vector<Alternative>& all = cause.mechanisms;
  const bool alike = std::all_of(all.begin(), all.end(), [&](const Alternative& one) {
    const Effect* const effect = FindEffect(one.id);  // null: an effect of the user's
    return effect == nullptr || GroupOf(*effect) == cause.group;
  });
  if (alike || all.front().probability >= probability * cause.probability) return said;
  said.clear();
  double sum = 0;
  for (const Alternative& one : all) {
    if (sum >= probability * cause.probability) break;
    said.push_back(one);
    sum += one.probability;
  }
  return said;
}

// A cause by its name, or as one of a set: "either partial shading (70 %) or a shunt (17 %)".
std::string TitleOf(const Cause& cause, double probability) {
  if (!std::isfinite(cause.probability)) {
    return cause.title + (cause.equivalents.empty() ? "" : " (or what looks like it)");
  }
  std::vector<Alternative> said = SaidOf(cause, probability);
  const std::vector<Alternative> beside = SaidBeside(cause, probability);
  said.insert(said.end(), beside.begin(), beside.end());
  std::stable_sort(said.begin(), said.end(), [](const Alternative& a, const Alternative& b) {
    return a.probability > b.probability;
  });
  std::vector<std::string> titles;
  titles.reserve(said.size());
  for (const Alternative& one : said) {
    titles.push_back(fmt::format("{} ({:.0f} %)", one.title, 100 * one.probability));
  }
  return (titles.size() > 1 ? "either " : "") + Alternatives(titles);
}

std::string Titles(const std::vector<Cause>& causes, double probability) {
  std::string text;
  for (std::size_t c = 0; c < causes.size(); ++c) {
    if (c > 0) text += c + 1 < causes.size() ? ", " : " and ";
    text += TitleOf(causes[c], probability);
  }
  return text;
}

std::string CausesSentence(const Verdict& verdict, const Floors& floors, double probability) {
  std::string titles = Titles(verdict.causes, probability);
  if (!LeavesTooMuch(verdict, floors)) return "The data show " + titles + ".";
  constexpr double kMost = 0.5;
  const bool most = verdict.remaining.value <= kMost * verdict.lack_of_fit.value;
  titles.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(titles.front())));
  return fmt::format("{} would explain {} of it; {} remain unexplained.", titles,
                     most ? "most" : "a part", OfIsc(verdict.remaining.value));
}

// How much the model with the causes misses, against modules without a fault.
std::string ComparisonText(const Verdict& verdict, const Floors& floors) {
  if (!verdict.found || IsNameless(verdict) || !floors.Any()) return "";
  const char* const causes = verdict.causes.size() > 1 ? "causes" : "cause";
  const std::string with = OfIsc(verdict.remaining.value);
  if (verdict.lack_of_fit.value < kLeastShown) {
    return fmt::format("{} with the {} and without; healthy modules {}", with, causes, Usual());
  }
  return fmt::format("{} with the {}, {:.2f} without; healthy modules {}", with, causes,
                     100 * verdict.lack_of_fit.value, Usual());
}

}  // namespace

std::vector<Alternative> SaidBeside(const Cause& cause, double probability) {
  constexpr std::size_t kMost = 2;
  std::vector<Alternative> beside;
  double sum = cause.probability;
  if (!std::isfinite(sum)) return beside;
  for (const Alternative& other : cause.alternatives) {
    if (sum >= probability || beside.size() == kMost) break;
    beside.push_back(other);
    sum += other.probability;
  }
  return beside;
}

Sized LeftBy(const WeightedData& weighted, const LawFit& fit) {
  double noise = 0, count = 0;
  for (std::size_t k = 0; k < fit.current.size(); ++k) {
    if (weighted.used[k] == 0 || weighted.readings->points[k].suns_voc) continue;
    noise += weighted.sigma[k] * weighted.sigma[k];
    ++count;
  }
  noise /= std::max(count, 1.0);
  const double lack_of_fit = MissedBy(weighted, fit);
  const double left = std::sqrt(std::max(lack_of_fit * lack_of_fit - noise, 0.0));
  // Of so few pieces the size is known to about a third.
  const double half = left * kNormal95 / std::sqrt(2 * kPiecesOfSweep);
  return {left, left - half, left + half};
}

bool MissesTooMuch(const Verdict& verdict, const Floors& floors) {
  return floors.Any() && verdict.lack_of_fit.value > std::max(kMostHealthy, floors.current);
}

bool LeavesTooMuch(const Verdict& verdict, const Floors& floors) {
  if (verdict.unexplained) return true;
  return floors.Any() && verdict.remaining.value > std::max(kMostHealthy, floors.current);
}

std::string NotShownBy(const DataTraits& traits) {
  std::vector<std::string> never;
  if (!traits.only_dark) never.emplace_back("dirt or slight ageing of all cells alike");
  never.emplace_back("resistance of the leads");
  if (traits.temperature_levels < 2) never.emplace_back("a wrong temperature");
  const bool flash = traits.setup == Setup::kFlash;
  if (traits.single && !traits.up_down && !traits.only_dark && !flash) {
    never.emplace_back("light that fades steadily");
  }
  if (!traits.single && !traits.only_dark && traits.module) {
    never.emplace_back(
        "shade, unlike cells and light that moved, which each curve by itself shows");
  }
  return Alternatives(never);
}

std::string AssumedDiodes(const DataTraits& traits) {
  if (traits.bypass_known || traits.substrings == 0) return "";
  return fmt::format("number of bypass diodes not given: assumed {}, one for {:.3g} cells",
                     traits.substrings, static_cast<double>(traits.cells) / traits.substrings);
}

void DescribeVerdict(const Selection& selection, const Floors& floors,
                     const std::vector<DeviceFinding>& findings, double probability,
                     Verdict* verdict) {
  const DataTraits& traits = selection.weighted.readings->traits;
  verdict->remaining = LeftBy(selection.weighted, selection.extended);
  verdict->comparison = ComparisonText(*verdict, floors);
  verdict->not_shown = NotShownBy(traits);
  if (IsNameless(*verdict)) {
    verdict->sentence = fmt::format(
        "Something is there that noise does not explain ({}), and none of the known causes fits.",
        OfIsc(verdict->remaining.value));
  } else if (!verdict->found) {
    verdict->sentence =
        NothingSentence(*verdict, floors, selection.weighted, findings, probability);
  } else {
    verdict->sentence = CausesSentence(*verdict, floors, probability);
  }
  const std::string assumed = AssumedDiodes(traits);
  if (!assumed.empty()) verdict->sentence += " Note: " + assumed + " (--bypass-diodes).";
}

}  // namespace lyrefit
