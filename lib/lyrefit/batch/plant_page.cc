#include "lyrefit/batch/plant_page.h"

#include <cerrno>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
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

constexpr char kRowsHere[] = "<!--rows-->";  // no row can contain this text, since rows are escaped

class StreamedPage : public PlantPage {
 public:
  StreamedPage(const std::string& path, std::vector<ResultColumn> columns, PlantPageOptions options)
      : path_(path),
        page_(path),
        rows_(OpenScratch(path)),
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
    TRY(page_.Write(shell.substr(0, rows)));
    TRY(page_.WriteFrom(rows_));
    TRY(page_.Write(shell.substr(rows)));
    return page_.Commit();
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
