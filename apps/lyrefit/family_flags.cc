#include "family_flags.h"

#include "flags.h"

namespace lyrefit {
namespace {

constexpr char kGroup[] = "Family";

}  // namespace

void AddFamilyFlags(VerbLine* verb, FamilyFlags* flags, ReportFlags* output) {
  const auto read_family = [flags](const std::string& text) -> Expected<void> {
    flags->family = FromText<Family>(text);
    if (flags->family) return {};
    return Fail("expected one of " + AllTexts<Family>() + ", found '" + text + "'");
  };
  verb->AddReader(
          "--family", read_family,
          "one device behind all curves of a set, by the law desoto, pvsyst or cec, or the "
          "better of the first two with one or two diodes: auto; free fits every curve on its own")
      .Type("NAME")
      .OneOf(AllTexts<Family>())
      .Group(kGroup);
  AddNamedFlags(verb, kFamilyOptionTable,
                {"shunt", "recombination", "residuals", "key-point-errors", "weights", "free",
                 "search-curves", "fit-curves", "folds", "leave-out"},
                &flags->options);
  verb->AddOption("--against", &flags->against_files,
                  "parameters from elsewhere, tested on the same curves: what --pvlib writes here "
                  "or in datasheet, pvlib's own as JSON, a PVsyst .PAN file, a row of SAM's "
                  "library of modules (FILE#NAME); once for each")
      .OneEach()
      .Type("FILE")
      .Reads()
      .Group(kGroup);
  AddNamedFlags(verb, kFamilyOptionTable, {"individual-fits"}, &flags->options);
  AddTableFlags(verb, kFamilyOptionTable, &flags->options);
  verb->AddOption("--csv", &output->csv_file, "the parameters of each curve as a table, a row each")
      .Writes();
  verb->AddOption("--pvlib", &flags->pvlib_file,
                  "the shared parameters as pvlib takes them, JSON; - for standard output, alone")
      .Writes();
  verb->AddOption("--pan", &flags->pan_file,
                  "the electrical model as a PVsyst .PAN file, by the law pvsyst; - for standard "
                  "output, alone")
      .Writes();
  verb->AddOption(
          "--sam", &flags->sam_file,
          "a library of one module as SAM and pvlib read it, by the law cec or desoto; - for "
          "standard output, alone")
      .Writes();
}

}  // namespace lyrefit
