#include "paper/corner_page.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/model/model_points.h"
#include "lyrefit/model/term.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/study/report/documents.h"

// All texts in this file are Markdown.
namespace lyrefit {
namespace {

using block::Table;

// Current of a diode at a terminal voltage of the solved model, in A.
double DiodeAmpere(const FitReport& report, int diode, double voltage_V) {
  const std::vector<double>& p = report.refined;
  const OperatingPoint at = SolveOperatingPoint(report.device, p.data(), voltage_V);
  const double per_volt = 1 / (p[IdealityIndex(diode)] * report.device.module_thermal_voltage_V);
  return -DiodeCurrent(p[SaturationCurrentIndex(diode)], per_volt, at.junction_voltage_V);
}

// Index of the diode with the smaller n; a fit may return the diodes in any order.
int Steep(const FitReport& report) {
  return report.refined[IdealityIndex(0)] < report.refined[IdealityIndex(1)] ? 0 : 1;
}

std::string SixDigits(double value) { return Significant(value, 6); }

Section Introduction(const CornerStudy& study) {
  Section section = {"Photowatt-PWP201 with two diodes: equal answers are no proof"};
  AddSentence(
      fmt::format("For this module with two diodes the literature reports {} A (measured-current) "
                  "again and again. In the bounds that it searches itself the optimum is {} A, a "
                  "third less, and that is proved. What is reported is the optimum of one diode: "
                  "the second one is its twin or carries nothing.",
                  Scientific(study.literature_A(), 6), Scientific(study.optimum_A(), 10)),
      &section);
  AddSentence(
      "How it could stay unseen: in a study that does ask whether more metaheuristics are needed "
      "(repository ShuhuaGao/rePVest, `DE/src/DE.ipynb`; Is of the first diode up to 0.01 uA only, "
      "which holds the optimum too), 30 runs of differential evolution give 0.00242507 A as "
      "minimum, "
      "mean and maximum, with a standard deviation of 2.4e-17 A. Agreement of runs says that they "
      "end in the same place, not that it is the lowest one. The log of the same study's branch "
      "and "
      "bound does hold a [lower point](../published/README.md#proofs-elsewhere).",
      &section);
  AddSentence(
      "And the optimum is of no use: its second diode has n = 0.27, where a junction has 1 to 2. "
      "With n from 1 on, one diode is proved to be the best for any number of them "
      "([certified optima](../README.md#certified-optima)). Bounds that allow nonsense are what is "
      "wrong here, and a search that misses nonsense is not thereby right.",
      &section);
  AddSentence(
      fmt::format(
          "This page and its picture are written by `cmake/results.sh` (alone by "
          "`build/tests/paper/lyrefit_paper data/paper --only pwp201`, within a minute). "
          "Every RMSE is measured-current unless said otherwise; CODATA constants, seed {}, "
          "lyrefit {}.",
          study.options.seed, study.version),
      &section);
  section.blocks.push_back(
      block::Figure{"What both leave of the readings, and where every run ends", "pwp201.svg"});
  return section;
}

Section ProofSection(const CornerStudy& study) {
  const Certificate& proof = study.certificate;
  const FloorDiode& steepest = proof.floor.diodes.back();
  Section section = {"The optimum, proved"};
  AddSentence(
      fmt::format("The literature's box is `../pwp201/bounds-literature.json`: n from 1 to 50 for "
                  "the module, so [{0:.4g}, {1:.5g}] per cell, Rs up to {2:g} ohm. A branch and "
                  "bound over Rs and n (`lyrefit certify data/pwp201 --n-lower {0:.9g} --n-upper "
                  "{1:.9g} --rs-upper {2:g}`) proves:",
                  proof.options.n_lower, proof.options.n_upper, proof.options.rs_upper_ohm),
      &section);
  Table table = {"lrrr", {{"diodes", "RMSE (A)", "proved to within (relative)", "certified"}}};
  const char* const names[] = {"one", "two"};
  for (int m = 0; m < 2; ++m) {
    const ModelCertificate& model = proof.models[m];
    table.rows.push_back({names[m], Scientific(model.rmse_A, 10), Significant(model.gap, 2),
                          model.certified ? "yes" : "no"});
  }
  table.rows.push_back({"any number", Scientific(proof.floor.rmse_A, 10),
                        Significant(proof.floor.gap, 2), proof.floor.certified ? "yes" : "no"});
  AddTable(std::move(table), &section);
  AddSentence(
      fmt::format(
          "Three diodes reach the last line, with a third one at the lowest n of the box, "
          "{:.4g}: Is = {} A, which carries {} A at {:.2f} V. Its exponent there is {:.0f}. "
          "Programs cut exponents somewhere, lyrefit's law at {:.0f}; of such a diode the "
          "cut makes a step, here at {:.2f} V, which fits anything and is no diode. So a "
          "measured-current figure below this floor is that of a step among the diodes, not of "
          "diodes; `lyrefit fit` begins n where no reading comes to the cut, here at {:.4g}, and "
          "says so. The solved current has a floor of its own, and other diodes reach it "
          "([tables](../README.md#certified-optima)).",
          steepest.n, Significant(steepest.saturation_current_A, 3),
          Significant(steepest.current_A, 2), proof.reference_voltage_V,
          proof.reference_voltage_V / (steepest.n * proof.module_thermal_voltage_V),
          kLargestExponent, kLargestExponent * steepest.n * proof.module_thermal_voltage_V,
          study.two.steepest_n),
      &section);
  return section;
}

std::string EndsText(const CornerEnds& ends) {
  return fmt::format("{} / {} / {} / {}", ends.optimum, ends.between, ends.literature, ends.above);
}

struct Level {
  const char* name;
  double RunRecord::*end_A;
};
constexpr Level kLevels[] = {{"search alone", &RunRecord::searched_A},
                             {"and one bounded solve", &RunRecord::plain_polished_A},
                             {"and the best candidate's polish", &RunRecord::own_polished_A},
                             {"and all starts", &RunRecord::polished_A}};

// Selects the random baseline, the actual searches, or both.
enum class Whose { kRandom, kSearches, kAll };

// Runs with an RMSE at the optimum, between the optimum and the literature's RMSE, at the latter,
// and all.
struct Count {
  int optimum = 0;
  int between = 0;
  int literature = 0;
  int runs = 0;
};

Count CountOf(const CornerStudy& study, double RunRecord::*end_A, Whose whose = Whose::kAll) {
  Count count;
  for (const AlgorithmResult& compared : study.comparison.problems.at(0).algorithms) {
    const bool random = compared.algorithm == ToText(Algorithm::kRandom);
    if (whose != Whose::kAll && random != (whose == Whose::kRandom)) continue;
    const CornerEnds ends = CountEnds(study, compared, end_A);
    count.optimum += ends.optimum;
    count.between += ends.between;
    count.literature += ends.literature;
    count.runs += static_cast<int>(compared.runs.size());
  }
  return count;
}

void AddVerdict(const CornerStudy& study, Section* section) {
  const Count alone = CountOf(study, &RunRecord::searched_A);
  const Count random = CountOf(study, &RunRecord::plain_polished_A, Whose::kRandom);
  const Count searched = CountOf(study, &RunRecord::plain_polished_A, Whose::kSearches);
  const Count own = CountOf(study, &RunRecord::own_polished_A);
  const Count all = CountOf(study, &RunRecord::polished_A);
  const int steep = SaturationCurrentIndex(Steep(study.two));
  AddSentence(
      fmt::format(
          "Of {} runs {} reach the optimum by the search alone; {} end at the literature's "
          "figure and {} a little below it. At the optimum the steep diode has Is = {} A, "
          "in a range up to {:g} A that is searched evenly, and no budget here makes up for that.",
          alone.runs, alone.optimum, alone.literature, alone.between,
          Significant(study.two.refined[steep], 2), study.two.estimates[steep].bounds.upper),
      section);
  AddSentence(
      fmt::format(
          "One bounded solve from the best point reaches it in {} of {} runs behind random "
          "points, in {} of {} behind the searches: what has converged to one diode gives "
          "the solve nothing to go on. The best candidate's own polish reaches it in {} of {}, "
          "all starts in {} of {}: with Rs and n given the currents are solved for exactly, "
          "and where a diode has none, all n are looked through for one that the "
          "residuals ask for.",
          random.optimum, random.runs, searched.optimum, searched.runs, own.optimum, own.runs,
          all.optimum, all.runs),
      section);
}

Section EndsSection(const CornerStudy& study) {
  Section section = {"Where searches end"};
  AddSentence(
      fmt::format(
          "{} runs of each in that box, n from {:.4g} on for the reason above. A cell "
          "counts the runs that end at the optimum / "
          "between it and the literature's figure / at that figure / above it; \"at\" is "
          "within 1e-6 of it. One bounded solve is one least-squares solve from the best "
          "point, the best candidate's polish and all starts are lyrefit's "
          "([how](../../lib/lyrefit/estimate/fit/README.md)). The last search has the settings of "
          "the study above.",
          study.options.runs, study.two.steepest_n),
      &section);
  Table table = {"lrrrrr", {{"search", "evaluations"}}};
  for (const Level& level : kLevels) table.heads[0].push_back(level.name);
  for (const AlgorithmResult& compared : study.comparison.problems.at(0).algorithms) {
    const std::size_t at = compared.name.rfind('@');
    Table::Row row = {compared.algorithm, compared.name.substr(at + 1)};
    for (const Level& level : kLevels) {
      row.push_back(EndsText(CountEnds(study, compared, level.end_A)));
    }
    table.rows.push_back(std::move(row));
  }
  AddTable(std::move(table), &section);
  AddVerdict(study, &section);
  return section;
}

Table ParameterTable(const CornerStudy& study) {
  const FitReport& one = study.one;
  const FitReport& two = study.two;
  const int steep = Steep(two);
  Table table = {"lrr", {{"", "one diode (the literature's two)", "two diodes (the optimum)"}}};
  const auto row = [&](const std::string& name, double a, double b,
                       std::string (*text)(double) = SixDigits) {
    table.rows.push_back({name, text(a), text(b)});
  };
  const auto rmse = [](double value) { return Scientific(value, 10); };
  row("RMSE, measured-current (A)", one.rmse.refined.measured_current_A,
      two.rmse.refined.measured_current_A, rmse);
  row("RMSE, solved-current, at the same place (A)", one.rmse.refined.solved_current_A,
      two.rmse.refined.solved_current_A);
  row("Iph (A)", one.refined[kIph], two.refined[kIph]);
  row("Rs (ohm)", one.refined[kRs], two.refined[kRs]);
  row("Rsh (ohm)", one.refined[kRsh], two.refined[kRsh]);
  row("n", one.refined[IdealityIndex(0)], two.refined[IdealityIndex(1 - steep)]);
  row("Is (A)", one.refined[SaturationCurrentIndex(0)],
      two.refined[SaturationCurrentIndex(1 - steep)]);
  row("n of the second diode", kUnknown, two.refined[IdealityIndex(steep)]);
  row("Is of the second diode (A)", kUnknown, two.refined[SaturationCurrentIndex(steep)]);
  const IvCurve& curve = two.curve;
  const struct {
    const char* where;
    double one_V, two_V;
  } places[] = {
      {"at maximum power", one.simulated.max_power_voltage_V, two.simulated.max_power_voltage_V},
      {"at open circuit", one.simulated.open_circuit_voltage_V,
       two.simulated.open_circuit_voltage_V},
      {"at the last reading", curve.voltage_V.back(), curve.voltage_V.back()}};
  for (const auto& place : places) {
    row(fmt::format("first diode carries {} (A)", place.where), DiodeAmpere(one, 0, place.one_V),
        DiodeAmpere(two, 1 - steep, place.two_V));
    row(fmt::format("second diode carries {} (A)", place.where), kUnknown,
        DiodeAmpere(two, steep, place.two_V));
  }
  return table;
}

Section PhysicsSection(const CornerStudy& study) {
  const FitReport& two = study.two;
  const int steep = Steep(two);
  const double n = two.refined[IdealityIndex(steep)];
  const double decade_V = n * two.device.module_thermal_voltage_V /
                          two.curve.conditions.cells_in_series * std::log(10.0);
  Section section = {"What the two optima are"};
  AddTable(ParameterTable(study), &section);
  const FitReport& solved = study.two_solved;
  AddSentence(
      fmt::format(
          "The second diode takes {:.0f} mV of each cell's voltage for a decade of current, a "
          "junction takes {:.0f} mV or more at this temperature. It carries next to nothing at "
          "maximum power and sets in sharply around open circuit: it bends the end of the curve "
          "that one diode and a straight Rs do not bend, and Rs grows from {} to {} ohm to make "
          "room for it. Whatever bends it, it is no junction; the readings ask for it all the same "
          "(AICc {:.1f} against {:.1f}, the lower the better, errors taken as independent). Fitted "
          "to the solved current, two diodes end in the same corner: n = {}, {} A; what is proved "
          "of "
          "that stands among the [certified optima](../README.md#certified-optima).",
          1e3 * decade_V, 1e3 * decade_V / n, Significant(study.one.refined[kRs], 4),
          Significant(two.refined[kRs], 4), two.criteria.aicc, study.one.criteria.aicc,
          Significant(solved.refined[IdealityIndex(Steep(solved))], 4),
          Scientific(solved.rmse.refined.solved_current_A, 10)),
      &section);
  return section;
}

}  // namespace

std::string CornerPage(const CornerStudy& study) {
  Document page;
  page.head = Introduction(study);
  page.sections = {ProofSection(study), EndsSection(study), PhysicsSection(study)};
  return DrawMarkdown(page, Texts::kMarkdown);
}

}  // namespace lyrefit
