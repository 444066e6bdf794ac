#include "paper/sound_page.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/text_layout.h"
#include "paper/held_tables.h"
#include "paper/page_blocks.h"

// All texts in this file are Markdown.
namespace lyrefit {
namespace {

std::vector<block::Any> MeasuredBlocks(const SoundStudy& study) {
  return {block::Sentence{fmt::format(
              "{} certificates of {} curves ({} more have no certificate), n in [1, 2], effort {}: "
              "{} bounds, {} of them above what `fit` or another search reaches.",
              study.held.size(), study.held.size() / 2, study.unusable / 2, study.options.effort,
              BoundsHeld(study), Violations(study))},
          BoundsTable(study), PointsTable(study)};
}

Section Introduction(const SoundStudy& made) {
  Section section = {"Proved bounds, held against what is known"};
  AddSentence(
      fmt::format(
          "A proved bound that lies above something attained is no proof. {} made problems, both "
          "objectives of each: {} certificates with {} bounds, **{} of them above the lowest RMSE "
          "known** by more than rounding (1e-14 of the largest current). Known are the parameters "
          "that the problem was made from, the certificate's own, refined starts from a grid and "
          "at random, and random parameters as they are; what fewer diodes reach, more reach too.",
          made.options.problems, made.held.size(), BoundsHeld(made), Violations(made)),
      &section);
  AddSentence(
      fmt::format(
          "Devices: cells and modules of 36 cells with one to three diodes, 8 to 60 points, every "
          "tenth 100 to 300; residuals from 1e-6 to 3e-2 of Isc; n in [1, 2] or [0.5, 4], a third "
          "with ranges of Iph, Is and Rsh too. Every proof may solve {} convex problems for the "
          "floor and for each model (`lyrefit certify` takes {}); seed {}, lyrefit {}. The two "
          "objectives stand beside each other and are not compared.",
          made.options.effort, CertifyOptions().effort, made.options.seed, made.version),
      &section);
  AddSentence(
      fmt::format("`build/tests/paper/lyrefit_paper data/paper --only sound` writes this page and "
                  "took {:.0f} minutes for it, on four cores that others used as well; "
                  "`cmake/results.sh` writes it with all others. Seconds are of one such core. "
                  "Exit code 2: some bound is above.",
                  std::ceil(made.seconds / 60)),
      &section);
  return section;
}

Section PlantedSection(const SoundStudy& made) {
  Section section = {"Planted optima"};
  AddSentence(
      "In four fifths of the problems the optimum is put in first: parameters are chosen, and "
      "residuals that are orthogonal to the columns of light, leak and the diodes and to what "
      "moves their n and Rs, with no column of a diode of any n in the range along them. The "
      "measured points follow in closed form. For the measured current with Rs fixed this is the "
      "optimum over all mixtures, without any search, for the problem is convex. With Rs free, and "
      "for the solved current, it is a stationary point: where the certificate is complete it "
      "proves or refutes that nothing is lower.",
      &section);
  AddTable(PlantedTable(made), &section);
  return section;
}

}  // namespace

std::string SoundPage(const SoundStudy& made) {
  Document page;
  page.head = Introduction(made);
  Section bounds = {"Bounds and gaps"};
  AddTable(BoundsTable(made), &bounds);
  AddSentence(
      "A gap is (RMSE - bound) / RMSE of the certificate itself; certified is a gap of at most "
      "1e-9, or nothing but rounding. The highest bound over what is attained may lie above zero "
      "by rounding, where residuals are small.",
      &bounds);
  Section open = {"Where gaps stay open"};
  AddSentence("By the size of the residuals:", &open);
  AddTable(NoiseTable(made), &open);
  AddSentence("By the range of n:", &open);
  AddTable(RangeTable(made), &open);
  AddSentence("By points:", &open);
  AddTable(PointsTable(made), &open);
  AddSentence("The widest gaps of the model that the device has:", &open);
  AddTable(WorstTable(made, 10), &open);
  page.sections = {bounds, PlantedSection(made), open};
  return DrawMarkdown(page, Texts::kMarkdown);
}

std::string WithWide(std::string page, const SoundStudy& study) {
  const std::vector<block::Any> blocks = {
      block::Sentence{fmt::format(
          "{} made problems with Rs from 0 to 0.9 to 1.7 times the largest voltage over the "
          "largest "
          "current, a third of them ending before their open circuit (`build/tests/paper/"
          "lyrefit_paper data/paper --only wide --update lib/lyrefit/certify/README.md`, seed {}, "
          "effort {}): {} bounds, {} of them above what is attained.",
          study.held.size(), study.options.seed, study.options.effort, BoundsHeld(study),
          Violations(study))},
      BoundsTable(study)};
  return ReplaceBlock(page, "proofs-wide",
                      DrawMarkdown({{}, {"", blocks}}, Texts::kMarkdown) + "\n");
}

std::string WithMeasured(std::string page, const SoundStudy& study) {
  const std::string drawn = DrawMarkdown({{}, {"", MeasuredBlocks(study)}}, Texts::kMarkdown);
  return ReplaceBlock(page, "proofs-measured", drawn + "\n");
}

}  // namespace lyrefit
