#include <filesystem>
#include <utility>

#include <zlib.h>

#include "lyrefit/base/try.h"
#include "lyrefit/read/cells.h"
#include "lyrefit/read/curve_text.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/line_scanner.h"
#include "lyrefit/stream/row_names.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// A file that is read whole: by ReadCurve when its only curve is wanted, or completely at the first
// call of Next(). With whole_cells its items are cells.
class WholeFile : public FileInput {
 public:
  WholeFile(const std::string& path, std::string name, bool several, const ReadOptions& options)
      : FileInput(path, options), name_(std::move(name)), several_(several) {}

  Expected<std::optional<FoundCurve>> Next() override {
    if (next_ == 0 && several_) Load();
    const std::size_t count = several_ ? curves_.size() : 1;
    if (next_ == count) return std::optional<FoundCurve>();
    FoundCurve found;
    found.in_file = static_cast<std::int64_t>(next_++);
    found.id = name_;
    if (count > 1) {
      const std::string& own = curves_[found.in_file].id;
      found.id += "/" + (own.empty() ? std::to_string(found.in_file + 1) : own);
    }
    found.begin = size() * found.in_file / static_cast<std::int64_t>(count);
    found.end = size() * (found.in_file + 1) / static_cast<std::int64_t>(count);
    return std::optional<FoundCurve>(std::move(found));
  }

  BatchCurve Read(const BatchItem& item) const override {
    if (options_.whole_files) return {item.id, IvCurve(), {}, {}, path_};
    if (!several_) return {item.id, ReadCurve(path_, options_), {}};
    const NamedCurve& found = curves_[item.in_file];
    Expected<IvCurve> curve = found.curve;
    if (curve) curve->name = item.id;
    return {item.id, std::move(curve), {}, found.more};
  }

  Expected<void> AddTo(ByteSum* sum, std::int64_t until) const override {
    if (until <= 0) return {};
    TRY(sum->AddFile(path_, size()));
    const std::string sidecar = fs::path(path_).replace_extension(".json").string();
    if (sidecar == path_ || !IsFile(sidecar)) return {};
    return sum->AddFile(sidecar, SizeOfFile(sidecar));
  }

 private:
  struct NamedCurve {
    std::string id;  // in the file
    Expected<IvCurve> curve;
    std::vector<IvCurve> more = {};  // the others of the same cell
  };

  void Load() {
    Expected<CurveSet> set = ReadSet();
    if (!set) return Refuse(set.error());
    for (IvCurve& curve : set->curves) {
      curve.assumptions.insert(curve.assumptions.begin(), set->assumptions.begin(),
                               set->assumptions.end());
      if (options_.whole_cells && options_.area_cm2) curve.notes.area_cm2 = options_.area_cm2;
    }
    const std::vector<RejectedCurve> rejected = std::move(set->rejected);
    if (options_.whole_cells) {
      for (CellCurves& cell : SplitIntoCells(std::move(*set))) AddCell(std::move(cell));
    } else {
      for (IvCurve& curve : set->curves) {
        curves_.push_back({AsLevel(curve.name), std::move(curve)});
      }
    }
    for (const RejectedCurve& one : rejected) {
      curves_.push_back({AsLevel(one.id), tl::unexpected(one.error)});
    }
  }

  Expected<CurveSet> ReadSet() const {
    if (options_.whole_cells) return ReadMeasurement(path_, options_);
    TRY(const auto text, ReadDecodedFile(path_, options_.largest_file_bytes));
    return CurveSetOfFile(text, path_, options_);
  }

  void AddCell(CellCurves cell) {
    NamedCurve named = {AsLevel(cell.name), std::move(cell.curves.front())};
    cell.curves.erase(cell.curves.begin());
    named.more = std::move(cell.curves);
    curves_.push_back(std::move(named));
  }

  void Refuse(const Error& error) { curves_.push_back({"", tl::unexpected(error)}); }

  const std::string name_;
  const bool several_;
  std::vector<NamedCurve> curves_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<BatchInput> WholeFileInput(const std::string& path, const std::string& name,
                                           bool several, const ReadOptions& options) {
  return std::make_unique<WholeFile>(path, name, several, options);
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

std::string StemOfInput(const std::string& path) {
  return IsReadOnce(path) ? "input" : fs::path(path).stem().string();
}

std::int64_t SizeOfFile(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return 0;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : static_cast<std::int64_t>(size);
}

}  // namespace lyrefit
