#include "lyrefit/batch/plant_page.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "lyrefit/base/descriptor.h"
#include "lyrefit/base/new_file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/plant_assets.h"
#include "lyrefit/batch/plant_document.h"
#include "lyrefit/batch/plant_summary.h"
#include "lyrefit/batch/plant_table.h"
#include "lyrefit/report/page_shell.h"

namespace lyrefit {
namespace {

tl::unexpected<Error> CannotWrite(const std::string& path) {
  return Fail("cannot write the page: " + std::generic_category().message(errno), path);
}

// A file without a name, which disappears when it is closed. It is in the folder of the page, since
// that folder has the space for it.
int OpenNameless(const std::string& page) {
  std::error_code error;
  const std::string beside =
      IsWrittenInPlace(page) ? (std::filesystem::temp_directory_path(error) / "lyrefit").string()
                             : page;
  std::string name = beside + ".rows-XXXXXX";
  const int number = ::mkostemp(name.data(), O_CLOEXEC);
  if (number >= 0) ::unlink(name.c_str());
  return number;
}

constexpr char kRowsHere[] = "<!--rows-->";  // no row can contain this text, since rows are escaped

class StreamedPage : public PlantPage {
 public:
  StreamedPage(const std::string& path, std::vector<ResultColumn> columns, PlantPageOptions options)
      : path_(path),
        page_(path),
        rows_(OpenNameless(path)),
        options_(std::move(options)),
        counter_(columns),
        table_(std::move(columns), options_.digits) {}

  Expected<void> Begin() { return rows_.open() ? page_.Begin() : CannotWrite(path_); }

  Expected<void> Add(const ResultRow& row) override {
    counter_.Add(row);
    return table_.Add(row) ? WriteGroup() : Expected<void>();
  }

  Expected<void> Finish() override {
    TRY(WriteGroup());
    const std::string shell = Shell();
    const std::size_t rows = shell.find(kRowsHere);
    TRY(page_.Add(shell.substr(0, rows)));
    TRY(CopyRows());
    TRY(page_.Add(shell.substr(rows)));
    TRY(page_.Complete());
    return page_.Name();
  }

 private:
  std::string Shell() const {
    const PlantSummary summary = counter_.Summary();
    PageShell shell;
    shell.title = options_.plant;
    shell.summary = PlantHead(summary);
    shell.body = PlantBody(summary, options_) + kRowsHere;
    shell.style = PlantStyle();
    shell.scripts = {std::string(PlantScript())};
    shell.data = {{"table", table_.Index()}, {"results", nlohmann::json(options_.results).dump()}};
    return DrawShell(shell);
  }

  Expected<void> WriteGroup() {
    const std::string group = table_.TakeGroup();
    if (group.empty()) return {};
    const bool written =
        rows_.Write("<script type=\"text/plain\" class=\"rows\">" + group + "</script>\n");
    return written ? Expected<void>() : CannotWrite(path_);
  }

  Expected<void> CopyRows() {
    std::string block(std::size_t{1} << 20, '\0');
    ::lseek(rows_.number(), 0, SEEK_SET);
    while (true) {
      const ssize_t got = ::read(rows_.number(), block.data(), block.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return CannotWrite(path_);
      if (got == 0) return {};
      TRY(page_.Add(std::string_view(block).substr(0, static_cast<std::size_t>(got))));
    }
  }

  const std::string path_;
  NewFile page_;
  const Descriptor rows_;
  PlantPageOptions options_;
  PlantCounter counter_;
  PlantTable table_;
};

}  // namespace

Expected<std::unique_ptr<PlantPage>> PlantPage::Open(const std::string& file,
                                                     std::vector<ResultColumn> columns,
                                                     PlantPageOptions options) {
  if (columns.empty()) return Fail("a plant's page needs at least one column", file);
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    return Fail("expected a file for the page, found a folder", file);
  }
  auto page = std::make_unique<StreamedPage>(file, std::move(columns), std::move(options));
  TRY(page->Begin());
  return page;
}

}  // namespace lyrefit
