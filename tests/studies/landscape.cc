#include "studies/landscape.h"

#include <fmt/format.h>

#include "lyrefit/base/random.h"
#include "studies/landscape_draw.h"

namespace lyrefit {
namespace {

constexpr int kMostDevices = 10000;
constexpr int kMostDraws = 100;

struct ProblemRow {
  LandscapeProblem problem;
  Expected<LandscapeCase> (*draw)(RandomStream* random);
};

// A problem's position selects its random streams. New problems must therefore be appended at the
// end.
const std::vector<ProblemRow>& ProblemRows() {
  using Random = RandomStream*;
  static const std::vector<ProblemRow> rows = {
      {{"strings_2", "two lights, one of two substrings each"},
       [](Random r) { return DrawLights(2, r); }},
      {{"strings_3", "three lights, one of three substrings each"},
       [](Random r) { return DrawLights(3, r); }},
      {{"strings_4", "four lights, one of four substrings each"},
       [](Random r) { return DrawLights(4, r); }},
      {{"strings_5", "five lights, one of five substrings each"},
       [](Random r) { return DrawLights(5, r); }},
      {{"strings_unlike", "two to four lights over three to six substrings, shares unknown"},
       [](Random r) { return DrawUnlikeLights(/*covered=*/false, r); }},
      {{"strings_covered", "the same, each shade on part of its substrings' cells alone"},
       [](Random r) { return DrawUnlikeLights(/*covered=*/true, r); }},
      {{"weak_cell_soft", "a weak cell that conducts softly in reverse, its law unknown"},
       [](Random r) { return DrawWeakCell(ReverseLaw::kSoft, r); }},
      {{"weak_cell_bishop", "a weak cell that breaks down by Bishop's law, its law unknown"},
       [](Random r) { return DrawWeakCell(ReverseLaw::kBishop, r); }},
      {{"two_causes_step", "a shaded substring and a step of the irradiance during the sweep"},
       DrawShadeAndStep},
      {{"two_causes_shunt", "a shaded substring and a non-ohmic shunt"}, DrawShadeAndShunt},
      {{"family_offsets", "a family of curves, the sensors' common errors fitted"},
       [](Random r) { return DrawFamily(/*effects=*/false, r); }},
      {{"family_effects", "the same, the errors as effects of the law"},
       [](Random r) { return DrawFamily(/*effects=*/true, r); }},
      {{"td_wide", "three diodes in the wide box, n from 0.5 to 10"}, DrawThreeDiodes},
  };
  return rows;
}

// Device number `device` of the problem at position `place`.
Expected<LandscapeCase> DrawCase(std::size_t place, int device, std::uint64_t seed) {
  const ProblemRow& row = ProblemRows()[place];
  RandomStream random(seed, place * kMostDevices + device);
  Expected<LandscapeCase> drawn = row.draw(&random);
  for (int draw = 1; !drawn && draw < kMostDraws; ++draw) drawn = row.draw(&random);
  if (!drawn) return drawn;
  const std::string name = fmt::format("{} {}", row.problem.name, device);
  drawn->problem = row.problem.name;
  (drawn->set ? drawn->set->name : drawn->curve.name) = name;
  return drawn;
}

}  // namespace

const std::vector<LandscapeProblem>& LandscapeProblems() {
  static const std::vector<LandscapeProblem> problems = [] {
    std::vector<LandscapeProblem> list;
    for (const ProblemRow& row : ProblemRows()) list.push_back(row.problem);
    return list;
  }();
  return problems;
}

Expected<std::vector<LandscapeCase>> MakeLandscape(const std::string& problem, int devices,
                                                   std::uint64_t seed) {
  if (devices < 1 || devices > kMostDevices) {
    return Fail(fmt::format("expected 1 to {} devices, found {}", kMostDevices, devices));
  }
  const std::vector<LandscapeProblem>& all = LandscapeProblems();
  std::string names;
  std::size_t place = 0;
  for (; place < all.size() && all[place].name != problem; ++place) {
    names += (names.empty() ? "" : ", ") + all[place].name;
  }
  if (place == all.size()) {
    return Fail(fmt::format("no problem {}: expected one of {}", problem, names));
  }
  std::vector<LandscapeCase> cases;
  for (int d = 0; d < devices; ++d) {
    Expected<LandscapeCase> drawn = DrawCase(place, d, seed);
    if (!drawn) return tl::unexpected(drawn.error());
    cases.push_back(std::move(*drawn));
  }
  return cases;
}

CompareCurve SubjectOf(LandscapeCase made) {
  CompareCurve subject;
  subject.curve = std::move(made.curve);
  subject.bounds = std::move(made.bounds);
  subject.problem = std::move(made.problem);
  subject.model = made.model;
  subject.with = std::move(made.with);
  subject.set = std::move(made.set);
  subject.family = std::move(made.family);
  return subject;
}

}  // namespace lyrefit
