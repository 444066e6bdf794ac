#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/read/json_curves.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/json_elements.h"
#include "lyrefit/stream/json_row.h"
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

}  // namespace lyrefit
