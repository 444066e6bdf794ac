#include "request.h"

#include <utility>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

using nlohmann::ordered_json;

// Rows that the page needs and no option table has: the index of the curve in a file, the automatic
// model, the search bounds, the sheet of a module and further curves among the files.
constexpr char kCurve[] = "curve";
constexpr char kModule[] = "module";
constexpr char kWithCurve[] = "with-curve";
constexpr char kModel[] = "model";
constexpr char kBounds[] = "bounds";
constexpr char kAuto[] = "auto";

void DescribeReading(ordered_json* rows) {
  DescribeTable(kConditionOptionTable, ConditionOptions(), rows);
  DescribeTable(kReadOptionTable, ReadOptions(), rows);
}

// Conditions and reading of one curve.
void DescribeCurve(ordered_json* rows) {
  DescribeReading(rows);
  rows->push_back({{"group", "Reading"},
                   {"name", kCurve},
                   {"unit", "INDEX"},
                   {"doc", "which curve of a file that holds several"},
                   {"kind", "text"},
                   {"choices", ordered_json::array()}});
}

// A choice among the page's files: `kind` is "module", "curves" (several may be chosen).
void DescribeFile(const char* group, const char* name, const char* kind, const char* doc,
                  ordered_json* rows) {
  rows->push_back({{"group", group},
                   {"name", name},
                   {"unit", "FILE"},
                   {"doc", doc},
                   {"kind", kind},
                   {"choices", ordered_json::array()}});
}

ordered_json DescribeFit() {
  ordered_json rows = ordered_json::array();
  DescribeCurve(&rows);
  DescribeTable(kFitOptionTable, FitOptions(), &rows);
  for (ordered_json& row : rows) {
    if (row["name"] == kModel) row["choices"].push_back(kAuto);
  }
  rows.push_back({{"group", "Model"},
                  {"name", kBounds},
                  {"unit", "NAME"},
                  {"doc", "the box that is searched: physical, derived from the curve, or wide"},
                  {"kind", "text"},
                  {"choices", {"physical", "wide"}},
                  {"default", "physical"}});
  DescribeTable(kSearchOptionTable, SearchOptions(), &rows);
  return rows;
}

ordered_json DescribeDiagnose() {
  ordered_json rows = ordered_json::array();
  DescribeReading(&rows);
  DescribeTable(kDiagnoseOptionTable, DiagnoseOptions(), &rows);
  return rows;
}

ordered_json DescribeTranslate() {
  ordered_json rows = ordered_json::array();
  DescribeCurve(&rows);
  TranslateOptions usual;
  DescribeTable(kTranslateOptionTable, usual, &rows);
  DescribeFile("Field test", kModule, "module",
               "a file above with the sheet of the module: rating, technology, coefficients; what "
               "is said here counts before it",
               &rows);
  ForNestedTables(&usual, [&rows](const auto& table, const auto* nested) {
    DescribeTable(table, *nested, &rows);
  });
  DescribeFile("Measurement", kWithCurve, "curves",
               "one or two further curves of the same device under other conditions, for "
               "procedure 3",
               &rows);
  DescribeTable(TranslateDiagnosisRows(), usual.diagnosis, &rows, "Diagnosis");
  return rows;
}

ordered_json DescribeCell() {
  ordered_json rows = ordered_json::array();
  DescribeReading(&rows);
  DescribeTable(kCellOptionTable, CellOptions(), &rows);
  return rows;
}

ordered_json DescribeSheet() {
  ordered_json rows = ordered_json::array();
  DescribeTable(kStatedSheetTable, StatedSheet(), &rows);
  DescribeFile(
      "Data sheet", kModule, "module",
      "a file above that repeats the sheet: PVsyst's .PAN, a row of SAM's library, pvlib's "
      "JSON; what is said here counts before it",
      &rows);
  return rows;
}

// Removes the text of an option from a form; empty if it is not set.
std::string Take(const std::string& name, FormTexts* form) {
  const auto found = form->find(name);
  if (found == form->end() || found->second.empty()) return "";
  std::string text = found->second.front();
  form->erase(found);
  return text;
}

Expected<void> ReadReading(FormTexts* form, ReadingForm* file) {
  const std::string curve = Take(kCurve, form);
  if (!curve.empty()) {
    int index = 0;
    if (auto read = ReadNumber(curve, &index); !read) {
      return Fail(std::string(kCurve) + ": " + read.error().message);
    }
    file->reading.curve = index;
  }
  TRY(ReadForm(kReadOptionTable, form, &file->reading));
  return ReadForm(kConditionOptionTable, form, &file->conditions);
}

Expected<void> CheckNothingLeft(const FormTexts& form) {
  if (form.empty()) return {};
  return Fail("there is no option '" + form.begin()->first + "'");
}

// Reads one text, or a list of texts.
Expected<std::vector<std::string>> TextsOf(const std::string& name, const nlohmann::json& value) {
  std::vector<std::string> texts;
  for (const nlohmann::json& each : value.is_array() ? value : nlohmann::json::array({value})) {
    if (!each.is_string()) return Fail(name + ": expected text");
    if (!each.get_ref<const std::string&>().empty()) texts.push_back(each);
  }
  return texts;
}

}  // namespace

Expected<PageRequest> ReadRequest(const std::string& json) {
  const nlohmann::json asked = nlohmann::json::parse(json, nullptr, false);
  if (!asked.is_object()) return Fail("expected a request in JSON");
  PageRequest request;
  const auto text = [&asked](const char* name) {
    const auto found = asked.find(name);
    return found != asked.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  request.verb = text("verb");
  request.file = text("file");
  if (const auto files = asked.find("files"); files != asked.end()) {
    TRY(request.files, TextsOf("files", *files));
  }
  const auto options = asked.find("options");
  if (options == asked.end()) return request;
  if (!options->is_object()) return Fail("options: expected an object");
  for (const auto& [name, value] : options->items()) {
    TRY(std::vector<std::string> texts, TextsOf(name, value));
    if (!texts.empty()) request.form[name] = std::move(texts);
  }
  return request;
}

ordered_json ErrorJson(const Error& error) {
  return {{"error", error.ToString()},
          {"message", error.message},
          {"file", error.file},
          {"line", error.line},
          {"column", error.column}};
}

ordered_json DescribeForms() {
  return {{"fit", DescribeFit()},
          {"diagnose", DescribeDiagnose()},
          {"translate", DescribeTranslate()},
          {"cell", DescribeCell()},
          {"datasheet", DescribeSheet()}};
}

Expected<ReadingForm> ReadLookForm(FormTexts form) {
  ReadingForm file;
  TRY(ReadReading(&form, &file));
  return file;
}

Expected<FitForm> ReadFitForm(FormTexts form) {
  FitForm fit;
  TRY(ReadReading(&form, &fit.file));
  if (form[kModel] == std::vector<std::string>{kAuto}) {
    fit.automatic = true;
    form.erase(kModel);
  }
  if (form[kModel].empty()) form.erase(kModel);
  const std::string bounds = Take(kBounds, &form);
  if (!bounds.empty() && bounds != "physical" && bounds != "wide") {
    return Fail("bounds: expected physical or wide, found '" + bounds + "'");
  }
  TRY(ReadForm(kFitOptionTable, &form, &fit.options));
  if (!bounds.empty()) fit.options.bounds.name = bounds;
  if (!fit.options.with.empty()) {
    if (fit.automatic) {
      return Fail("model auto chooses among diodes alone: say which model stands beside 'with'");
    }
    const SearchOptions usual = FitOptions::SearchBesideShapes();
    fit.options.search.population = usual.population;
    fit.options.search.iterations = usual.iterations;
  }
  TRY(ReadForm(kSearchOptionTable, &form, &fit.options.search));
  fit.options.threads = 1;
  TRY(CheckNothingLeft(form));
  return fit;
}

Expected<DiagnoseForm> ReadDiagnoseForm(FormTexts form) {
  DiagnoseForm diagnose;
  TRY(ReadReading(&form, &diagnose.file));
  TRY(ReadForm(kDiagnoseOptionTable, &form, &diagnose.options));
  diagnose.options.threads = 1;
  TRY(CheckNothingLeft(form));
  return diagnose;
}

Expected<TranslateForm> ReadTranslateForm(FormTexts form) {
  TranslateForm translate;
  TRY(ReadReading(&form, &translate.file));
  TranslateOptions& options = translate.options;
  TRY(ReadForm(kTranslateOptionTable, &form, &options));
  Expected<void> read;
  ForNestedTables(&options, [&](const auto& table, auto* nested) {
    if (read) read = ReadForm(table, &form, nested);
  });
  TRY(std::move(read));
  TRY(ReadForm(TranslateDiagnosisRows(), &form, &options.diagnosis));
  options.diagnosis.threads = 1;
  ShareSeedAndThreads(&options);
  translate.module = Take(kModule, &form);
  translate.further = std::move(form[kWithCurve]);
  form.erase(kWithCurve);
  TRY(CheckNothingLeft(form));
  return translate;
}

Expected<CellForm> ReadCellForm(FormTexts form) {
  CellForm cell;
  TRY(ReadReading(&form, &cell.file));
  TRY(ReadForm(kCellOptionTable, &form, &cell.options));
  cell.options.threads = 1;
  TRY(CheckNothingLeft(form));
  return cell;
}

Expected<StatedSheet> ReadSheetForm(FormTexts form) {
  StatedSheet sheet;
  sheet.file = Take(kModule, &form);
  TRY(ReadForm(kStatedSheetTable, &form, &sheet));
  TRY(CheckNothingLeft(form));
  return sheet;
}

}  // namespace lyrefit
