#include "paper/held_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

using block::Table;
using Chosen = std::vector<const HeldCertificate*>;

constexpr Objective kObjectives[] = {Objective::kMeasuredCurrent, Objective::kSolvedCurrent};

Chosen Choose(const SoundStudy& study, const std::function<bool(const HeldCertificate&)>& wanted) {
  Chosen chosen;
  for (const HeldCertificate& held : study.held) {
    if (wanted(held)) chosen.push_back(&held);
  }
  return chosen;
}

// The floor for `diodes` 0, otherwise the bound of the model; nullptr if the model was not
// certified.
const HeldBound* BoundOf(const HeldCertificate& held, int diodes) {
  if (diodes == 0) return &held.floor;
  return diodes <= static_cast<int>(held.models.size()) ? &held.models[diodes - 1] : nullptr;
}

std::vector<HeldBound> BoundsOf(const Chosen& chosen, int diodes) {
  std::vector<HeldBound> bounds;
  for (const HeldCertificate* held : chosen) {
    if (const HeldBound* bound = BoundOf(*held, diodes)) bounds.push_back(*bound);
  }
  return bounds;
}

std::string Percent(double part, double all) {
  return all > 0 ? fmt::format("{:.1f} %", 100 * part / all) : "-";
}

std::string CertifiedShare(const std::vector<HeldBound>& bounds) {
  double certified = 0;
  for (const HeldBound& bound : bounds) certified += bound.certified ? 1 : 0;
  return Percent(certified, static_cast<double>(bounds.size()));
}

std::string Gaps(const std::vector<HeldBound>& bounds, double share) {
  std::vector<double> gaps;
  for (const HeldBound& bound : bounds) gaps.push_back(bound.gap);
  return fmt::format("{:.1e}", QuantileOf(gaps, share));
}

std::string SecondsText(const Chosen& chosen, double share) {
  std::vector<double> seconds;
  for (const HeldCertificate* held : chosen) seconds.push_back(held->seconds);
  const double value = QuantileOf(seconds, share);
  return value < 10 ? Significant(value, 2) : fmt::format("{:.0f}", value);
}

// Number of diodes of the largest model in the study.
int MostDiodes(const SoundStudy& study) {
  return study.held.empty() ? 0 : static_cast<int>(study.held[0].models.size());
}

std::string NameOf(int diodes) {
  return diodes == 0 ? "floor" : ToText(static_cast<Model>(diodes));
}

// A class of certificates and its membership test.
struct Kind {
  std::string name;
  std::function<bool(const HeldCertificate&)> has;
};

// Certified shares and seconds, one row per objective and class.
Table KindTable(const SoundStudy& study, const std::string& what, const std::vector<Kind>& kinds) {
  Table table = {"llr", {{"objective", what, "problems"}}};
  const int most = MostDiodes(study);
  for (int m = 0; m <= most; ++m) table.heads[0].push_back(NameOf(m) + " certified");
  for (const char* head : {"seconds, median", "90 %", "longest"}) table.heads[0].emplace_back(head);
  table.alignment.append(static_cast<std::size_t>(most) + 4, 'r');
  for (const Objective objective : kObjectives) {
    for (const Kind& kind : kinds) {
      const Chosen chosen = Choose(study, [&](const HeldCertificate& held) {
        return held.objective == objective && kind.has(held);
      });
      if (chosen.empty()) continue;
      Table::Row row = {ToText(objective), kind.name, std::to_string(chosen.size())};
      for (int m = 0; m <= most; ++m) row.push_back(CertifiedShare(BoundsOf(chosen, m)));
      for (const double share : {0.5, 0.9, 1.0}) row.push_back(SecondsText(chosen, share));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::vector<Kind> RangesOfNumber(const std::vector<double>& ends, const std::string& format,
                                 const std::function<double(const HeldCertificate&)>& number) {
  std::vector<Kind> kinds;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double low = ends[i], high = ends[i + 1];
    kinds.push_back({fmt::format(fmt::runtime(format), low, high),
                     [=](const auto& held) { return number(held) >= low && number(held) < high; }});
  }
  return kinds;
}

}  // namespace

double QuantileOf(std::vector<double> values, double share) {
  if (values.empty()) return kUnknown;
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * last));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Table BoundsTable(const SoundStudy& study) {
  Table table = {
      "llrrrrrrrr",
      {{"objective", "bound of", "bounds", "above what is attained",
        "highest, bound / attained - 1", "certified", "gap, median", "90 %", "99 %", "widest"}}};
  for (const Objective objective : kObjectives) {
    const Chosen chosen =
        Choose(study, [&](const HeldCertificate& held) { return held.objective == objective; });
    for (int m = 0; m <= MostDiodes(study); ++m) {
      const std::vector<HeldBound> bounds = BoundsOf(chosen, m);
      if (bounds.empty()) continue;
      int violated = 0;
      double highest = -kInfinity;
      for (const HeldBound& bound : bounds) {
        violated += bound.violated ? 1 : 0;
        if (bound.best_A > 0) highest = std::max(highest, bound.above());
      }
      Table::Row row = {ToText(objective),
                        NameOf(m),
                        std::to_string(bounds.size()),
                        std::to_string(violated),
                        fmt::format("{:.1e}", highest),
                        CertifiedShare(bounds)};
      for (const double share : {0.5, 0.9, 0.99, 1.0}) row.push_back(Gaps(bounds, share));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table NoiseTable(const SoundStudy& study) {
  return KindTable(study, "residuals, of Isc",
                   RangesOfNumber({1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1}, "from {:.0e}",
                                  [](const HeldCertificate& held) { return held.noise; }));
}

Table PointsTable(const SoundStudy& study) {
  return KindTable(study, "points",
                   RangesOfNumber({0, 25, 50, 100, 150, 200, 1e9}, "from {:.0f}",
                                  [](const HeldCertificate& held) { return 1.0 * held.points; }));
}

Table RangeTable(const SoundStudy& study) {
  return KindTable(study, "n in",
                   {{"[1, 2]", [](const auto& held) { return held.n_upper < 3; }},
                    {"[0.5, 4]", [](const auto& held) { return held.n_upper > 3; }}});
}

Table PlantedTable(const SoundStudy& study) {
  Table table = {"lrrrr",
                 {{"planted for", "problems", "proved to be the optimum of their model",
                   "nothing lower known, the proof left open", "something lower is attained"}}};
  for (const auto& [kind, name] : EnumTable<Planted>::kRows) {
    if (kind == Planted::kNothing) continue;
    const Objective objective =
        kind == Planted::kSolved ? Objective::kSolvedCurrent : Objective::kMeasuredCurrent;
    int counts[3] = {};
    for (const HeldCertificate& held : study.held) {
      if (held.planted != kind || held.objective != objective) continue;
      const HeldBound& bound = held.models[held.diodes - 1];
      const bool lowest = held.planted_A <= bound.best_A * (1 + kCertifiedGap);
      ++counts[!lowest ? 2 : bound.certified ? 0 : 1];
    }
    table.rows.push_back({std::string(name), std::to_string(counts[0] + counts[1] + counts[2]),
                          std::to_string(counts[0]), std::to_string(counts[1]),
                          std::to_string(counts[2])});
  }
  return table;
}

Table WorstTable(const SoundStudy& study, int count) {
  Table table = {"llrrrrrrr",
                 {{"problem", "objective", "diodes", "points", "residuals, of Isc", "n up to",
                   "gap of its model", "gap of the floor", "seconds"}}};
  std::vector<HeldCertificate> sorted = study.held;
  const auto gap = [](const HeldCertificate& held) { return held.models[held.diodes - 1].gap; };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& a, const auto& b) { return gap(a) > gap(b); });
  for (const HeldCertificate& held : sorted) {
    if (static_cast<int>(table.rows.size()) == count) break;
    table.rows.push_back({held.name, ToText(held.objective), std::to_string(held.diodes),
                          std::to_string(held.points), fmt::format("{:.1e}", held.noise),
                          fmt::format("{:g}", held.n_upper), fmt::format("{:.1e}", gap(held)),
                          fmt::format("{:.1e}", held.floor.gap), Significant(held.seconds, 2)});
  }
  return table;
}

int Violations(const SoundStudy& study) {
  int count = 0;
  for (const HeldCertificate& held : study.held) count += held.violations();
  return count;
}

int BoundsHeld(const SoundStudy& study) {
  int count = 0;
  for (const HeldCertificate& held : study.held) {
    count += 1 + static_cast<int>(held.models.size());
  }
  return count;
}

}  // namespace lyrefit
