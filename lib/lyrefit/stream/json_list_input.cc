#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/read/json_curves.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/json_elements.h"
#include "lyrefit/stream/row_curve.h"
#include "lyrefit/stream/row_names.h"

namespace lyrefit {
namespace {

using nlohmann::json;

constexpr char kIvCurves[] = "IV Curves";

// The curves of one list in a JSON document, in order.
class JsonList : public FileInput {
 public:
  JsonList(const std::string& path, std::string name, const std::optional<std::string>& key,
           const ReadOptions& options)
      : FileInput(path, options),
        name_(std::move(name)),
        key_(key),
        elements_(path_, key, options.largest_file_bytes) {}

  // Reads the members before and after the list, which apply to all its curves.
  Expected<void> ReadAround() {
    if (!key_) return {};
    JsonElements all(path_, key_, options_.largest_file_bytes);
    for (;;) {
      TRY(const auto element, all.Next());
      if (!element) break;
    }
    std::string text = all.around();
    const std::size_t list = text.rfind('[');
    if (list != std::string::npos && text.find_first_of("]}", list) != list + 1) {
      text.insert(list + 1, "]");
    }
    around_ = json::parse(text, nullptr, false);
    // The document is truncated; the error is reported at its end.
    if (!around_.is_object()) around_ = json::object();
    ScanJsonScalars(text, &scalars_);
    return {};
  }

  Expected<std::optional<FoundCurve>> Next() override {
    TRY(auto element, elements_.Next());
    if (!element) return std::optional<FoundCurve>();
    ForgetManyNames();
    text_ = std::move(element->text);
    FoundCurve found;
    Records fields;
    ScanJsonScalars(text_, &fields);
    found.line = element->line;
    found.in_file = count_++;
    found.id = key_ == kIvCurves ? "" : IdOf(fields.scalars);
    found.stated = !found.id.empty();
    if (!found.stated) found.id = IdOfElement(fields, found.in_file);
    found.begin = element->begin;
    found.end = element->end;
    found.bytes = text_;
    if (!element->broken.empty()) {
      found.error = Error{element->broken, path_, static_cast<int>(element->line)};
    }
    return std::optional<FoundCurve>(std::move(found));
  }

  BatchCurve Read(const BatchItem& item) const override {
    if (key_ == kIvCurves) return {item.id, ReadEntry(item), {}};
    return ReadJsonText(item.bytes, item, path_, scalars_.scalars, options_);
  }

  Expected<void> AddTo(ByteSum* sum, std::int64_t until) const override {
    // The text after the list affects all its curves.
    return sum->AddFile(path_, key_ && until > 0 ? size() : until);
  }

 private:
  // Id of a curve that states none.
  std::string IdOfElement(const Records& fields, std::int64_t number) const {
    if (key_ == kIvCurves) {
      for (const RecordScalar& scalar : fields.scalars) {
        if (scalar.name == "Index") return fmt::format("{}_{}", name_, scalar.text);
      }
    }
    return fmt::format("{}[{}]", name_, number);
  }

  // Reads an entry of an ivcurves file with the common data of the file.
  Expected<IvCurve> ReadEntry(const BatchItem& item) const {
    const auto refuse = [&](const Error& error) {
      const std::string first = fmt::format("\"{}\"[0]", kIvCurves);
      std::string message = error.message;
      for (std::size_t at; (at = message.find(first)) != std::string::npos;) {
        message.replace(at, first.size(), fmt::format("\"{}\"[{}]", kIvCurves, item.in_file));
        if (item.in_file == 0) break;
      }
      const int line = static_cast<int>(item.line) + std::max(error.line - 1, 0);
      return Fail(std::move(message), path_, line, error.column);
    };
    auto entry = ParseJson(item.bytes, path_);
    if (!entry) return refuse(entry.error());
    json document = around_;
    document[kIvCurves] = json::array({std::move(*entry)});
    auto entries = ReadIvCurvesEntries(document, path_);
    if (!entries) return refuse(entries.error());
    if (!entries->front().curve) return refuse(entries->front().curve.error());
    entries->front().curve->name = item.id;
    return std::move(entries->front().curve);
  }

  const std::string name_;
  const std::optional<std::string> key_;
  JsonElements elements_;
  json around_ = json::object();
  Records scalars_;
  std::string text_;
  std::int64_t count_ = 0;
};

}  // namespace

Expected<std::unique_ptr<BatchInput>> JsonListInput(const std::string& path,
                                                    const std::string& name,
                                                    const std::optional<std::string>& list,
                                                    const ReadOptions& options) {
  auto input = std::make_unique<JsonList>(path, name, list, options);
  TRY(input->ReadAround());
  return std::unique_ptr<BatchInput>(std::move(input));
}

namespace {

// An error with the line and column of a text of several lines.
tl::unexpected<Error> RefuseAt(std::string_view text, const RecordPlace& place,
                               const Error& error) {
  const std::size_t at = std::min<std::size_t>(std::max(error.column - 1, 0), text.size());
  const std::string_view before = text.substr(0, at);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  if (lines == 0) return place.Refuse(error.message, error.column);
  return place.Refuse(error.message, static_cast<int>(at - before.rfind('\n')), place.line + lines);
}

// Reads nested readings: tables as written by pandas, lists of records.
Expected<IvCurve> NestedCurve(std::string_view text, const RecordPlace& place,
                              const std::string& id, const ReadOptions& options) {
  auto document = ParseJson(std::string(text), place.file);
  if (!document) return place.Refuse(document.error().message);
  auto curves = FindJsonCurves(*document, place.file, options);
  if (!curves) return place.Refuse(curves.error().message);
  if (curves->size() != 1) {
    return place.Refuse(fmt::format("expected one curve in a row, found {}", curves->size()));
  }
  RawCurve raw = std::move(curves->curves.front());
  auto curve = FinishCurve(std::move(raw), options);
  if (!curve) return place.Refuse(curve.error().message);
  curve->name = id;
  return curve;
}

bool HasReadings(const Records& fields) {
  return std::any_of(fields.lists.begin(), fields.lists.end(), [](const Record& list) {
    return IsElectrical(MeaningOf(list.name).column.kind);
  });
}

void AddAround(const std::vector<RecordScalar>& around, Records* fields) {
  for (const RecordScalar& scalar : around) {
    const bool own =
        std::any_of(fields->scalars.begin(), fields->scalars.end(),
                    [&](const RecordScalar& other) { return other.name == scalar.name; });
    if (!own && MeaningOf(scalar.name).id == IdPart::kNone) fields->scalars.push_back(scalar);
  }
}

}  // namespace

BatchCurve ReadJsonText(std::string_view text, const BatchItem& item, const std::string& path,
                        const std::vector<RecordScalar>& around, const ReadOptions& options) {
  ForgetManyNames();
  const RecordPlace place{path, item.line};
  BatchCurve curve;
  curve.id = item.id;
  Records fields;
  if (const auto parsed = ParseJsonRow(text, &fields); !parsed) {
    curve.curve = RefuseAt(text, place, parsed.error());
    return curve;
  }
  AddAround(around, &fields);
  curve.beside = BesideOfRow(fields);
  curve.curve = fields.nested && !HasReadings(fields) ? NestedCurve(text, place, item.id, options)
                                                      : CurveOfRow(fields, place, item.id, options);
  return curve;
}

}  // namespace lyrefit
