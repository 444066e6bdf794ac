#include "family_flags.h"

#include "flags.h"

namespace lyrefit {
namespace {

constexpr char kGroup[] = "Family";
constexpr double kWorstAccuracy_K = 50;

template <class E>
E Parsed(const std::string& flag, const std::string& text) {
  const std::optional<E> value = FromText<E>(text);
  if (!value) {
    throw CLI::ValidationError(flag, "expected one of " + AllTexts<E>() + ", found '" + text + "'");
  }
  return *value;
}

void AddLawFlags(CLI::App* verb, FamilyFlags* flags) {
  FamilyOptions& options = flags->options;
  verb->add_option_function<std::string>(
          "--family",
          [flags](const std::string& text) { flags->family = Parsed<Family>("--family", text); },
          "one device behind all curves of a set, by the law desoto or pvsyst, or the better of "
          "them with one or two diodes: auto; free fits every curve on its own")
      ->type_name("NAME")
      ->group(kGroup);
  verb->add_option_function<std::string>(
          "--shunt",
          [&options](const std::string& text) {
            options.shunt = Parsed<ShuntLaw>("--shunt", text);
          },
          "how the shunt follows irradiance: " + AllTexts<ShuntLaw>() +
              " (default inverse for desoto, exponential for pvsyst)")
      ->type_name("NAME")
      ->group(kGroup);
  verb->add_flag("--recombination", options.recombination,
                 "pvsyst's recombination loss in the i-layer of thin films")
      ->group(kGroup);
  AddEnumFlag(verb, "--weights", "how curves count: every point alike, or relative to Isc",
              &options.weights)
      ->group(kGroup);
  AddListFlag(verb, "--free", "fit a parameter that else is held, EgRef; once for each",
              &options.freed)
      ->type_name("P")
      ->group(kGroup);
}

void AddCountFlag(CLI::App* verb, const char* flag, const std::string& doc, int least,
                  int* target) {
  verb->add_option(flag, *target, doc + " (default " + NumberText(*target) + ")")
      ->check(CLI::Range(least, 1000000).description(""))
      ->type_name("N")
      ->group(kGroup);
}

void AddCurveChoiceFlags(CLI::App* verb, FamilyFlags* flags) {
  FamilyOptions& options = flags->options;
  AddCountFlag(verb, "--search-curves", "well-spread curves that the search sees", 2,
               &options.search_curves);
  AddCountFlag(verb, "--fit-curves",
               "well-spread curves that are fitted, the others are tested; 0: all", 0,
               &options.fit_curves);
  AddCountFlag(verb, "--folds", "whole curves left out in turn, to test the answer; 0: none", 0,
               &options.folds);
  AddListFlag(verb, "--leave-out", "curves that are not fitted", &flags->leave_out)
      ->type_name("ID[,ID]")
      ->group(kGroup);
  AddListFlag(verb, "--against",
              "parameters from elsewhere, tested on the same curves: what --pvlib writes here or "
              "in datasheet, or pvlib's own as JSON; once for each",
              &flags->against_files)
      ->type_name("FILE")
      ->group(kGroup);
  verb->add_flag("--no-free-fits", flags->no_free_fits,
                 "do not also fit every curve on its own, the floor of the joint fit")
      ->group(kGroup);
}

void AddSensorFlags(CLI::App* verb, FamilyFlags* flags) {
  FamilyOptions& options = flags->options;
  verb->add_flag("--irradiance-offset", options.irradiance_offset,
                 "fit one error of the irradiance sensor, common to all curves")
      ->group(kGroup);
  verb->add_flag("--temperature-offset", options.temperature_offset,
                 "fit one error of the temperature sensor, common to all curves")
      ->group(kGroup);
  verb->add_option("--irradiance-accuracy", flags->irradiance_accuracy,
                   "standard deviation of each irradiance, in percent: 2 or 2%")
      ->type_name("PERCENT")
      ->group(kGroup);
  verb->add_option("--temperature-accuracy", options.temperature_accuracy_K,
                   "standard deviation of each temperature, in kelvin")
      ->check(CLI::Range(0.0, kWorstAccuracy_K).description(""))
      ->type_name("K")
      ->group(kGroup);
}

}  // namespace

void AddFamilyFlags(CLI::App* verb, FamilyFlags* flags) {
  AddLawFlags(verb, flags);
  AddCurveChoiceFlags(verb, flags);
  AddSensorFlags(verb, flags);
  verb->add_option("--truth", flags->truth_file,
                   "parameters the curves were made from, as the ivcurves contest states them: "
                   "prints the errors")
      ->type_name("FILE")
      ->group(kGroup);
  verb->add_option("--csv", flags->csv_file, "the parameters of each curve as a table")
      ->type_name("FILE")
      ->group("Output");
  verb->add_option("--pvlib", flags->pvlib_file,
                   "the shared parameters as pvlib takes them, JSON; - for standard output, alone")
      ->type_name("FILE")
      ->group("Output");
}

}  // namespace lyrefit
