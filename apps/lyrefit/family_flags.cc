#include "family_flags.h"

#include "flags.h"

namespace lyrefit {
namespace {

constexpr char kGroup[] = "Family";
constexpr double kWorstAccuracy_K = 50;

void AddLawFlags(Verb* verb, FamilyFlags* flags) {
  FamilyOptions& options = flags->options;
  verb->AddReader(
          "--family", EnumReader<Family>(&flags->family),
          "one device behind all curves of a set, by the law desoto or pvsyst, or the better of "
          "them with one or two diodes: auto; free fits every curve on its own")
      .Type("NAME")
      .Group(kGroup);
  verb->AddReader("--shunt", EnumReader<ShuntLaw>(&options.shunt),
                  "how the shunt follows irradiance: " + AllTexts<ShuntLaw>() +
                      " (default inverse for desoto, exponential for pvsyst)")
      .Type("NAME")
      .Group(kGroup);
  verb->AddSwitch("--recombination", &options.recombination,
                  "pvsyst's recombination loss in the i-layer of thin films")
      .Group(kGroup);
  AddEnumFlag(verb, "--weights", "how curves count: every point alike, or relative to Isc",
              &options.weights)
      .Group(kGroup);
  AddListFlag(verb, "--free", "fit a parameter that else is held, EgRef; once for each",
              &options.freed)
      .Type("P")
      .Group(kGroup);
}

void AddCountFlag(Verb* verb, const char* flag, const std::string& doc, int least, int& target) {
  verb->AddOption(flag, &target, doc + " (default " + NumberText(target) + ")")
      .Between(least, 1000000)
      .Type("N")
      .Group(kGroup);
}

void AddCurveChoiceFlags(Verb* verb, FamilyFlags* flags) {
  FamilyOptions& options = flags->options;
  AddCountFlag(verb, "--search-curves", "well-spread curves that the search sees", 2,
               options.search_curves);
  AddCountFlag(verb, "--fit-curves",
               "well-spread curves that are fitted, the others are tested; 0: all", 0,
               options.fit_curves);
  AddCountFlag(verb, "--folds", "whole curves left out in turn, to test the answer; 0: none", 0,
               options.folds);
  AddListFlag(verb, "--leave-out", "curves that are not fitted", &flags->leave_out)
      .Type("ID[,ID]")
      .Group(kGroup);
  AddListFlag(verb, "--against",
              "parameters from elsewhere, tested on the same curves: what --pvlib writes here or "
              "in datasheet, or pvlib's own as JSON; once for each",
              &flags->against_files)
      .Type("FILE")
      .Reads()
      .Group(kGroup);
  verb->AddSwitch("--no-free-fits", &flags->no_free_fits,
                  "do not also fit every curve on its own, the floor of the joint fit")
      .Group(kGroup);
}

void AddSensorFlags(Verb* verb, FamilyFlags* flags) {
  FamilyOptions& options = flags->options;
  verb->AddSwitch("--irradiance-offset", &options.irradiance_offset,
                  "fit one error of the irradiance sensor, common to all curves")
      .Group(kGroup);
  verb->AddSwitch("--temperature-offset", &options.temperature_offset,
                  "fit one error of the temperature sensor, common to all curves")
      .Group(kGroup);
  verb->AddOption("--irradiance-accuracy", &flags->irradiance_accuracy,
                  "standard deviation of each irradiance, in percent: 2 or 2%")
      .Type("PERCENT")
      .Group(kGroup);
  verb->AddOption("--temperature-accuracy", &options.temperature_accuracy_K,
                  "standard deviation of each temperature, in kelvin")
      .Between(0.0, kWorstAccuracy_K)
      .Type("K")
      .Group(kGroup);
}

}  // namespace

void AddFamilyFlags(Verb* verb, FamilyFlags* flags) {
  AddLawFlags(verb, flags);
  AddCurveChoiceFlags(verb, flags);
  AddSensorFlags(verb, flags);
  verb->AddOption("--truth", &flags->truth_file,
                  "parameters the curves were made from, as the ivcurves contest states them: "
                  "prints the errors")
      .Group(kGroup)
      .Type("FILE")
      .Reads();
  verb->AddOption("--csv", &flags->csv_file, "the parameters of each curve as a table, a row each")
      .Writes();
  verb->AddOption("--pvlib", &flags->pvlib_file,
                  "the shared parameters as pvlib takes them, JSON; - for standard output, alone")
      .Writes();
}

}  // namespace lyrefit
