#include "lyrefit/diagnose/verdict.h"

#include <gtest/gtest.h>

#include "diagnose/synthetic_data.h"
#include "golden.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {
namespace {

constexpr Floors kFloors = {0.0025, 0.005};

// A base fit of a clean curve as the extended model; the causes of `verdict` are said beside it.
Verdict Told(Verdict verdict, const std::vector<DeviceFinding>& findings = {},
             const Floors& floors = kFloors, const IvCurve& curve = SyntheticCurve({}),
             double sigma_A = 0.004) {
  const SyntheticData made = OnTheData(SetOf({curve}), sigma_A);
  Selection selection;
  selection.weighted = made.weighted;
  selection.extended = FitBase(made.weighted, Law());
  DescribeVerdict(selection, floors, findings, 0.8, &verdict);
  return verdict;
}

Cause NamedCause(const std::string& title) {
  Cause cause;
  cause.id = cause.title = title;
  return cause;
}

Verdict With(std::vector<Cause> causes, double lack_of_fit) {
  Verdict verdict;
  verdict.causes = std::move(causes);
  verdict.found = true;
  verdict.lack_of_fit.value = lack_of_fit;
  return verdict;
}

std::string TextOf(const Verdict& verdict) {
  std::string text = verdict.sentence + "\n";
  if (!verdict.comparison.empty()) text += "compared: " + verdict.comparison + "\n";
  if (!verdict.not_shown.empty()) text += "not shown: " + verdict.not_shown + "\n";
  return text;
}

// The data show a cause only if nothing is left; a misfit that no cause fits has its size.
TEST(DescribeVerdict, SaysHowProbableACauseIsAndWhatIsLeft) {
  Golden golden("verdict_sentences");
  const auto add = [&golden](const char* title, const Verdict& verdict) {
    golden.AddLong(title, TextOf(verdict));
  };
  const Cause weak = NamedCause("weak cells");
  add("a cause", Told(With({weak}, 0.05)));
  Verdict left = With({weak}, 0.05);
  left.unexplained = true;
  add("a cause that leaves a part", Told(left));
  Cause probable = weak;
  probable.probability = 0.86;
  probable.equivalents = {"shading"};
  add("a probable cause", Told(With({probable}, 0.05)));
  probable.probability = 0.7;
  probable.alternatives = {{"shading", "partial shading", 0.15}, {"none", "no cause", 0.1}};
  add("either of two causes", Told(With({probable}, 0.05)));
  probable.probability = kUnknown;
  add("two causes without probabilities", Told(With({probable, NamedCause("drift")}, 0.05)));
  Cause parts;  // of the device or the instrument: what there is to do depends on it
  parts.id = parts.effect = "hysteresis";
  parts.title = "hysteresis by ions or traps";
  parts.group = "device";
  parts.probability = 1;
  parts.mechanisms = {{"hysteresis", parts.title, 0.6},
                      {"timing_skew", "voltage and current not read together", 0.4}};
  add("a finding of several parts", Told(With({parts}, 0.002)));
  parts.mechanisms[0].probability = 0.9;
  add("a finding of one part", Told(With({parts}, 0.002)));
  add("no cause fits", Told(With({NamedCause("unknown_structure")}, 0.05)));
  Verdict silent;
  silent.lack_of_fit.value = 0.001;
  add("silence", Told(silent));
  add("a leak", Told({}, {{"leak", "", {0.031, 0.029, 0.033}, 0.016, 0.04, "", false, {}}}));
  Verdict misses;
  misses.lack_of_fit.value = 0.0056;
  misses.below_floor = {NamedCause("drift")};
  add("what is too small", Told(misses));
  Recipe early;
  early.to_V = 0.45;
  add("a sweep that ends early", Told({}, {}, kFloors, SyntheticCurve(early)));
  Verdict within;
  within.lack_of_fit.value = 1e-5;
  add("within the noise", Told(within));
  add("within a large noise", Told(within, {}, kFloors, SyntheticCurve({}), 0.08));
  DataTraits traits;
  golden.AddLong("one sweep cannot show", NotShownBy(traits));
  traits.up_down = true;
  golden.AddLong("sweeps up and down cannot show", NotShownBy(traits));
  traits.temperature_levels = 2;
  golden.AddLong("sweeps at two temperatures cannot show", NotShownBy(traits));
  golden.Check();
}

TEST(SaidBeside, AsManyAsReachTheProbability) {
  Cause cause = NamedCause("shading");
  cause.probability = 0.5;
  for (const auto& [id, probability] : {std::pair("drift", 0.3), {"clip", 0.15}, {"none", 0.05}}) {
    cause.alternatives.push_back({id, id, probability});
  }
  EXPECT_TRUE(SaidBeside(cause, 0.4).empty());
  ASSERT_EQ(SaidBeside(cause, 0.75).size(), 1u);
  EXPECT_EQ(SaidBeside(cause, 0.75)[0].id, "drift");
  EXPECT_EQ(SaidBeside(cause, 0.999).size(), 2u);
  cause.probability = kUnknown;
  EXPECT_TRUE(SaidBeside(cause, 0.75).empty());
}

}  // namespace
}  // namespace lyrefit
