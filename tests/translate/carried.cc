#include "translate/carried.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <cstdio>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/translate/translation_budget.h"

namespace shown {
namespace {

using lyrefit::Procedure;

constexpr Procedure kAll[] = {Procedure::kIec1,   Procedure::kIec2,   Procedure::kIec4,
                              Procedure::kDeSoto, Procedure::kPvsyst, Procedure::kExtended};
constexpr int kGroups = 10;  // groups of sweeps for the jackknife

lyrefit::UncertaintyOptions SizesOf(const Conditions& at) {
  lyrefit::UncertaintyOptions sizes;
  sizes.draws = 0;
  sizes.irradiance_percent = at.light_percent;
  sizes.temperature_K = at.temperature_K;
  sizes.cell_offset_K = 0;
  sizes.voltage_percent = sizes.current_percent = 0;  // the same instrument measured both sweeps
  if (at.beta_percent >= 0) sizes.beta_percent = at.beta_percent;
  sizes.alpha_percent = at.alpha_percent;
  sizes.epsilon_percent = at.epsilon_percent;
  return sizes;
}

// Uncertainty of the procedure itself, relative to Pmax, k = 2.
double OfProcedure(const Carried& row, const Sizes& sizes) {
  return std::hypot(sizes.light * std::sqrt(row.folds), sizes.temperature * std::sqrt(row.heat));
}

Tally Sum(const std::vector<const Carried*>& rows, int left_out) {
  Tally tally;
  for (const Carried* row : rows) {
    if (left_out >= 0 && (row->from % kGroups == left_out || row->to % kGroups == left_out)) {
      continue;
    }
    ++tally.count;
    tally.bias += row->error;
    tally.rms += row->error * row->error;
    tally.expanded += row->expanded;
    tally.within += std::fabs(row->error) <= row->expanded;
  }
  const double n = std::max(1, tally.count);
  tally.bias /= n;
  tally.rms = std::sqrt(tally.rms / n);
  tally.expanded /= n;
  tally.within /= n;
  return tally;
}

// Exact 95 % limits of a fraction (Clopper and Pearson 1934). At the lower limit `within` or more
// of `count` have a probability of 2.5 %, at the upper limit `within` or fewer.
double LowestShare(int within, int count) {
  return within <= 0 ? 0 : boost::math::ibeta_inv(within, count - within + 1.0, 0.025);
}
double HighestShare(int within, int count) {
  return within >= count ? 1 : boost::math::ibeta_inv(within + 1.0, count - within, 0.975);
}

}  // namespace

lyrefit::TranslateOptions ReadyOptions(bool diagnosed) {
  lyrefit::TranslateOptions options;
  options.diagnosis.held_out = false;
  options.diagnosis.threads = 1;
  if (!diagnosed) options.procedures = {Procedure::kIec1};
  return options;
}

std::vector<Sweep> MakeReady(const std::vector<lyrefit::IvCurve>& curves,
                             const lyrefit::TranslateOptions& options, int threads) {
  std::vector<std::optional<Sweep>> made(curves.size());
  lyrefit::ParallelFor(static_cast<int>(curves.size()), threads, [&](int i) {
    auto ready = lyrefit::Prepare(curves[i], options, {});
    if (!ready) {
      std::fprintf(stderr, "%s: %s\n", curves[i].name.c_str(), ready.error().message.c_str());
      return;
    }
    const lyrefit::KeyPoints key =
        lyrefit::KeyPointsBy(lyrefit::KeyPointMethod::kInterpolated, ready->curve.points);
    const lyrefit::KeyPointNoise noise = lyrefit::NoiseOfCurve(ready->curve, 1);
    made[i] = Sweep{std::move(*ready), key, noise};
  });
  std::vector<Sweep> sweeps;
  for (auto& each : made) {
    if (each && each->key.max_power_W > 0) sweeps.push_back(std::move(*each));
  }
  return sweeps;
}

std::vector<Carried> CarryOne(const Sweep& from, const lyrefit::TranslationTarget& target,
                              const lyrefit::KeyPoints& truth, const Conditions& at) {
  lyrefit::Preparation made = from.made;
  made.curve.target = target;
  const lyrefit::TranslationInputs& inputs = made.inputs.values;
  std::vector<lyrefit::TranslatedResult> results;
  for (const Procedure procedure : kAll) {
    lyrefit::TranslatedResult result;
    result.procedure = procedure;
    const auto key = lyrefit::TranslatedKeyPoints(procedure, made.curve, inputs);
    if (key) result.key_points = *key;
    if (!key) result.why_not = key.error().message;
    results.push_back(result);
  }
  const int best = lyrefit::Recommend(made, results).result;
  lyrefit::TranslationDoubts doubts;
  doubts.noise = from.noise;
  std::vector<Carried> rows;
  for (int i = 0; i < static_cast<int>(results.size()); ++i) {
    if (!results[i].computed()) continue;
    const auto budget = lyrefit::TranslationBudget(results[i].procedure, made.curve, made.inputs,
                                                   doubts, SizesOf(at));
    if (!budget) continue;
    Carried row;
    row.procedure = results[i].procedure;
    row.recommended = i == best;
    const std::vector<double> found = lyrefit::KeyPointVector(results[i].key_points);
    const std::vector<double> wanted = lyrefit::KeyPointVector(truth);
    for (std::size_t k = 0; k < row.errors.size(); ++k) {
      row.errors[k] = found[k] / wanted[k] - 1;
      row.expandeds[k] = budget->outputs[k].expanded_uncertainty / wanted[k];
    }
    row.error = row.errors[lyrefit::kMaxPowerOutput];
    row.expanded = row.expandeds[lyrefit::kMaxPowerOutput];
    row.folds = std::fabs(std::log(target.irradiance_W_m2 / inputs.irradiance_W_m2));
    row.heat = std::fabs(target.temperature_C - inputs.temperature_C) / 10;
    const lyrefit::TranslationError own = lyrefit::TranslationErrorOf(row.procedure);
    row.of_procedure = OfProcedure(
        row, {own.light[lyrefit::kMaxPowerOutput], own.temperature[lyrefit::kMaxPowerOutput]});
    rows.push_back(row);
  }
  return rows;
}

std::vector<Carried> CarryPairs(const std::vector<Sweep>& sweeps, const Conditions& at,
                                const Pairing& how) {
  std::vector<int> places;
  for (int i = 0; i < static_cast<int>(sweeps.size()); ++i) {
    if (how.allowed.empty() || how.allowed[i]) places.push_back(i);
  }
  std::vector<std::vector<Carried>> parts(how.pairs);
  lyrefit::ParallelFor(how.pairs, how.threads, [&](int k) {
    lyrefit::RandomStream random(how.seed, k);
    const auto draw = [&] { return places[static_cast<int>(random.Uniform() * places.size())]; };
    const int from = draw(), to = draw();
    if (from == to) return;
    const lyrefit::TranslationInputs& there = sweeps[to].made.inputs.values;
    parts[k] =
        CarryOne(sweeps[from], {there.irradiance_W_m2, there.temperature_C}, sweeps[to].key, at);
    for (Carried& row : parts[k]) {
      row.from = from;
      row.to = to;
    }
  });
  std::vector<Carried> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Tally TallyOf(const std::vector<Carried>& all, std::optional<Procedure> procedure,
              bool recommended) {
  std::vector<const Carried*> rows;
  for (const Carried& row : all) {
    if ((!procedure || row.procedure == *procedure) && (!recommended || row.recommended)) {
      rows.push_back(&row);
    }
  }
  Tally tally = Sum(rows, -1);
  double squares = 0;
  for (int group = 0; group < kGroups; ++group) {
    const double moved = Sum(rows, group).within - tally.within;
    squares += moved * moved;
  }
  tally.within_se = std::sqrt(squares * (kGroups - 1) / kGroups);
  return tally;
}

std::vector<Carried> WithSizes(const std::vector<Carried>& all, const Sizes& sizes) {
  std::vector<Carried> other = all;
  for (Carried& row : other) {
    const double inputs =
        std::max(0.0, row.expanded * row.expanded - row.of_procedure * row.of_procedure);
    row.of_procedure = OfProcedure(row, sizes);
    row.expanded = std::sqrt(inputs + row.of_procedure * row.of_procedure);
  }
  return other;
}

Sizes FittedSizes(const std::vector<Carried>& all, Procedure procedure) {
  std::vector<Carried> own;
  for (const Carried& row : all) {
    if (row.procedure == procedure) own.push_back(row);
  }
  constexpr int kSteps = 40;
  constexpr double kLargest = 0.08;
  Sizes best;
  double lowest = 1e300;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      // Quadratic spacing gives a fine grid at small values.
      const Sizes tried = {kLargest * i * i / (kSteps * kSteps),
                           kLargest / 2 * j * j / (kSteps * kSteps)};
      double surprise = 0;
      for (const Carried& row : WithSizes(own, tried)) {
        const double sigma = std::max(1e-5, row.expanded / 2);
        surprise += 2 * std::log(sigma) + row.error * row.error / (sigma * sigma);
      }
      if (surprise < lowest) {
        lowest = surprise;
        best = tried;
      }
    }
  }
  return best;
}

void PrintHeld(const std::vector<Carried>& all) {
  std::printf(
      "| procedure | n | Isc within U | mean U | Voc | mean U | Pmax | mean U |\n"
      "|---|---|---|---|---|---|---|---|\n");
  const auto print = [&all](const char* name, std::optional<Procedure> procedure,
                            bool recommended) {
    std::string row;
    int count = 0;
    for (const int k : {0, 1, lyrefit::kMaxPowerOutput}) {
      int within = 0;
      double expanded = 0;
      count = 0;
      for (const Carried& each : all) {
        if ((procedure && each.procedure != *procedure) || (recommended && !each.recommended)) {
          continue;
        }
        ++count;
        within += std::fabs(each.errors[k]) <= each.expandeds[k] ? 1 : 0;
        expanded += each.expandeds[k];
      }
      char text[120];
      std::snprintf(text, sizeof text, " %d (%.1f .. %.1f %%) | %.2f %% |", within,
                    100 * LowestShare(within, count), 100 * HighestShare(within, count),
                    100 * expanded / std::max(1, count));
      row += text;
    }
    if (count > 0) std::printf("| %s | %d |%s\n", name, count, row.c_str());
  };
  for (const Procedure procedure : kAll) {
    print(lyrefit::ToText(procedure).c_str(), procedure, false);
  }
  print("recommended", std::nullopt, true);
  for (const Procedure procedure : kAll) {
    print(("recommended: " + lyrefit::ToText(procedure)).c_str(), procedure, true);
  }
}

void PrintTable(const std::vector<Carried>& all) {
  std::printf(
      "| procedure | n | bias of Pmax | rms | mean U (k = 2) | within U |\n"
      "|---|---|---|---|---|---|\n");
  const auto print = [](const char* name, const Tally& tally) {
    if (tally.count == 0) return;
    std::printf("| %s | %d | %+.2f %% | %.2f %% | %.2f %% | %.1f +- %.1f %% |\n", name, tally.count,
                100 * tally.bias, 100 * tally.rms, 100 * tally.expanded, 100 * tally.within,
                100 * tally.within_se);
  };
  for (const Procedure procedure : kAll) {
    print(lyrefit::ToText(procedure).c_str(), TallyOf(all, procedure, false));
  }
  print("recommended", TallyOf(all, std::nullopt, true));
  for (const Procedure procedure : kAll) {
    print(("recommended: " + lyrefit::ToText(procedure)).c_str(), TallyOf(all, procedure, true));
  }
}

}  // namespace shown
