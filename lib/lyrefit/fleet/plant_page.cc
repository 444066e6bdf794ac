#include "lyrefit/fleet/plant_page.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "lyrefit/base/try.h"
#include "lyrefit/fleet/plant_assets.h"
#include "lyrefit/fleet/plant_document.h"
#include "lyrefit/fleet/plant_summary.h"
#include "lyrefit/fleet/plant_table.h"
#include "lyrefit/report/page_shell.h"

namespace lyrefit {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

tl::unexpected<Error> CannotWrite(const std::string& path) {
  return Fail("cannot write the page: " + std::generic_category().message(errno), path);
}

// A file that nobody else sees and that is gone when it is closed.
Expected<File> OpenNameless(const std::string& beside) {
  std::string name = beside + ".rows-XXXXXX";
  const int number = ::mkstemp(name.data());
  if (number < 0) return CannotWrite(beside);
  ::unlink(name.c_str());
  return File(::fdopen(number, "w+b"));
}

bool Put(const std::string& text, std::FILE* file) {
  return std::fwrite(text.data(), 1, text.size(), file) == text.size();
}

constexpr char kRowsHere[] = "<!--rows-->";  // no text of a row can hold it: it would be escaped

class StreamedPage : public PlantPage {
 public:
  StreamedPage(std::string path, File rows, std::vector<ResultColumn> columns,
               PlantPageOptions options)
      : path_(std::move(path)),
        rows_(std::move(rows)),
        options_(std::move(options)),
        counter_(columns),
        table_(std::move(columns), options_.digits) {}

  Expected<void> Add(const ResultRow& row) override {
    counter_.Add(row);
    return table_.Add(row) ? WriteGroup() : Expected<void>();
  }

  Expected<void> Finish() override {
    TRY(WriteGroup());
    const std::string temporary = fmt::format("{}.{}.tmp", path_, ::getpid());
    File page(std::fopen(temporary.c_str(), "wb"));
    if (!page) return CannotWrite(path_);
    const std::string shell = Shell();
    const std::size_t rows = shell.find(kRowsHere);
    bool written = Put(shell.substr(0, rows), page.get()) && CopyRows(page.get()) &&
                   Put(shell.substr(rows), page.get()) && std::fflush(page.get()) == 0;
    written = std::fclose(page.release()) == 0 && written;
    if (written && std::rename(temporary.c_str(), path_.c_str()) == 0) return {};
    const int reason = errno;
    std::remove(temporary.c_str());
    errno = reason;
    return CannotWrite(path_);
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
    if (!Put("<script type=\"text/plain\" class=\"rows\">" + group + "</script>\n", rows_.get())) {
      return CannotWrite(path_);
    }
    return {};
  }

  bool CopyRows(std::FILE* page) {
    if (std::fflush(rows_.get()) != 0) return false;
    std::rewind(rows_.get());
    std::string block(std::size_t{1} << 20, '\0');
    while (const std::size_t got = std::fread(block.data(), 1, block.size(), rows_.get())) {
      if (std::fwrite(block.data(), 1, got, page) != got) return false;
    }
    return std::ferror(rows_.get()) == 0;
  }

  std::string path_;
  File rows_;
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
  TRY(File rows, OpenNameless(file));
  return std::make_unique<StreamedPage>(file, std::move(rows), std::move(columns),
                                        std::move(options));
}

}  // namespace lyrefit
