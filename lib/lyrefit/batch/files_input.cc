#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include <zlib.h>

#include "lyrefit/base/try.h"
#include "lyrefit/batch/batch_input.h"
#include "lyrefit/batch/line_scanner.h"
#include "lyrefit/curve/json_curves.h"
#include "lyrefit/curve/read_ivcurves_json.h"
#include "lyrefit/curve/table_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// A file with one curve, read by ReadCurve.
class OneCurve : public BatchInput {
 public:
  OneCurve(std::string path, const ReadOptions& options)
      : path_(std::move(path)), options_(options), size_(SizeOfFile(path_) + 1) {}

  Expected<std::optional<FoundCurve>> Next() override {
    if (done_) return std::optional<FoundCurve>();
    done_ = true;
    FoundCurve found;
    found.id = IdOfPath(path_);
    found.end = size_;
    return std::optional<FoundCurve>(std::move(found));
  }

  BatchCurve Read(const BatchItem& item) const override {
    return {item.id, ReadCurve(path_, options_), {}};
  }

  std::int64_t size() const override { return size_; }
  Expected<void> AddTo(ByteSum* sum, std::int64_t until) const override {
    if (until <= 0) return {};
    TRY(sum->AddFile(path_, size_));
    const fs::path sidecar = fs::path(path_).replace_extension(".json");
    return IsFile(sidecar) ? sum->AddFile(sidecar.string(), SizeOfFile(sidecar.string()))
                           : Expected<void>();
  }
  void AddRemarks(std::vector<std::string>*) const override {}

 private:
  const std::string path_;
  const ReadOptions options_;
  const std::int64_t size_;
  bool done_ = false;
};

// A JSON document with curves at any position. It is read completely at the first call of Next().
class JsonWhole : public BatchInput {
 public:
  JsonWhole(std::string path, const ReadOptions& options)
      : path_(std::move(path)), options_(options), size_(SizeOfFile(path_) + 1) {}

  Expected<std::optional<FoundCurve>> Next() override {
    if (next_ == 0) Load();
    if (next_ == curves_.size()) return std::optional<FoundCurve>();
    const auto count = static_cast<std::int64_t>(curves_.size());
    FoundCurve found;
    found.number = static_cast<std::int64_t>(next_++);
    found.id = IdOfPath(path_);
    const RawOrError& one = curves_[found.number];
    if (count > 1) {
      const bool named = one && !one->curve.name.empty();
      found.id += "/" + (named ? one->curve.name : std::to_string(found.number + 1));
    }
    found.begin = size_ * found.number / count;
    found.end = size_ * (found.number + 1) / count;
    return std::optional<FoundCurve>(std::move(found));
  }

  BatchCurve Read(const BatchItem& item) const override {
    const RawOrError& one = curves_[item.number];
    if (!one) return {item.id, tl::unexpected(one.error()), {}};
    Expected<IvCurve> curve = FinishCurve(*one, options_);
    if (curve) curve->name = item.id;
    return {item.id, std::move(curve), {}};
  }

  std::int64_t size() const override { return size_; }
  Expected<void> AddTo(ByteSum* sum, std::int64_t until) const override {
    return until > 0 ? sum->AddFile(path_, size_) : Expected<void>();
  }
  void AddRemarks(std::vector<std::string>*) const override {}

 private:
  using RawOrError = Expected<RawCurve>;

  void Load() {
    const auto document = ReadJsonFile(path_, options_);
    auto curves = document ? FindJsonCurves(*document, path_, options_)
                           : Expected<std::vector<RawCurve>>(tl::unexpected(document.error()));
    if (!curves) {
      curves_.emplace_back(tl::unexpected(curves.error()));
      return;
    }
    for (RawCurve& curve : *curves) curves_.emplace_back(std::move(curve));
  }

  const std::string path_;
  const ReadOptions options_;
  const std::int64_t size_;
  std::vector<RawOrError> curves_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<BatchInput> OneCurveInput(const std::string& path, const ReadOptions& options) {
  return std::make_unique<OneCurve>(path, options);
}

std::unique_ptr<BatchInput> JsonWholeInput(const std::string& path, const ReadOptions& options) {
  return std::make_unique<JsonWhole>(path, options);
}

void ByteSum::Add(std::string_view text) {
  crc = ::crc32_z(crc, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  bytes += static_cast<std::int64_t>(text.size());
}

Expected<void> ByteSum::AddFile(const std::string& path, std::int64_t limit) {
  ByteInput file(path);
  std::vector<char> block(1U << 20);
  while (limit > 0) {
    const auto wanted = std::min<std::int64_t>(limit, static_cast<std::int64_t>(block.size()));
    TRY(const std::size_t got, file.Read(block.data(), static_cast<std::size_t>(wanted)));
    if (got == 0) break;
    Add(std::string_view(block.data(), got));
    limit -= static_cast<std::int64_t>(got);
  }
  return {};
}

std::string IdOfPath(const std::string& path) {
  fs::path plain = fs::path(path).lexically_normal();
  if (!plain.has_filename()) plain = plain.parent_path();
  if (plain.filename() == "curve.csv") plain = plain.parent_path();
  if (!IsFolder(path)) plain.replace_extension();
  std::string id;
  for (const fs::path& part : plain.relative_path()) {
    if (part != ".." && part != ".") id += (id.empty() ? "" : "/") + part.string();
  }
  return id;
}

bool IsReadOnce(const std::string& path) { return path == "-" || IsStream(path); }

std::string StemOf(const std::string& path) {
  return IsReadOnce(path) ? "input" : fs::path(path).stem().string();
}

std::int64_t SizeOfFile(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return 0;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : static_cast<std::int64_t>(size);
}

}  // namespace lyrefit
