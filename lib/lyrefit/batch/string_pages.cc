#include "lyrefit/batch/string_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <filesystem>
#include <system_error>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/checkpoint.h"
#include "lyrefit/report/page.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 120;  // bytes of a level; file systems allow slightly more
constexpr std::uintmax_t kLargestPage = 256U << 20;
constexpr std::size_t kLongestPath = 1000;  // bytes of all levels

bool IsCapital(char c) { return c >= 'A' && c <= 'Z'; }

bool IsPlain(char c) {
  return IsCapital(c) || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
         c == '-';
}

// Bit mask of the positions of capital letters in hexadecimal, least significant digit first.
std::string CapitalPlaces(const std::string& text) {
  std::string digits;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    unsigned nibble = 0;
    for (std::size_t b = 0; b < 4 && i + b < text.size(); ++b) {
      nibble |= IsCapital(text[i + b]) ? 1U << b : 0U;
    }
    digits += fmt::format("{:x}", nibble);
  }
  while (!digits.empty() && digits.back() == '0') digits.pop_back();
  return digits;
}

std::string Escaped(char c) { return fmt::format("~{:02x}", static_cast<unsigned char>(c)); }

// A unique file name for one level. A leading dot would hide the file or name a parent folder. The
// last dot could give a folder the name of a page. Both are escaped.
std::string SafeName(const std::string& piece) {
  std::string name;
  const std::size_t ending = piece.rfind('.');
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const bool dot = piece[i] == '.' && (i == 0 || i == ending);
    name += IsPlain(piece[i]) && !dot ? std::string(1, piece[i]) : Escaped(piece[i]);
  }
  const std::string capitals = CapitalPlaces(piece);
  return capitals.empty() ? name : name + "~." + capitals;
}

// A name for a level that would be too long: a UUID of its bytes (RFC 9562, version 5). No other
// name begins with "~_".
std::string DigestName(const std::string& text) {
  static const boost::uuids::name_generator_sha1 generate(boost::uuids::ns::oid());
  return "~_" + boost::uuids::to_string(generate(text));
}

std::string SafeLevel(const std::string& level) {
  if (level.empty()) return "~";
  const std::string name = SafeName(level);
  return name.size() <= kLongestName ? name : DigestName(level);
}

}  // namespace

std::string StringPagePath(const std::string& id) {
  std::string path;
  for (std::size_t from = 0; from <= id.size();) {
    const std::size_t slash = std::min(id.find('/', from), id.size());
    path += "/" + SafeLevel(id.substr(from, slash - from));
    from = slash + 1;
  }
  if (path.size() > kLongestPath) path = "/" + DigestName(id);
  return "pages" + path + ".html";
}

Expected<void> WriteStringPage(const std::string& folder, const std::string& path,
                               const std::string& html) {
  const fs::path file = fs::path(folder) / path;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) return Fail("cannot make the folder of a page: " + error.message(), file.string());
  return WriteTextFile(file.string(), html);
}

Expected<void> AddToStringPage(const std::string& folder, const std::string& path,
                               const std::vector<std::string>& lines, const std::string& own) {
  const std::string file = (fs::path(folder) / path).string();
  TRY(const std::string page, ReadTextFile(file, kLargestPage));
  return WriteTextFile(file, WithVerdictAhead(page, lines, own));
}

Expected<void> BringStringPages(const std::string& part, const std::string& folder) {
  TRY(CheckpointReader reader, CheckpointReader::Open(part));
  const fs::path from = fs::path(part).parent_path();
  std::error_code error;
  if (fs::equivalent(from, folder, error)) return {};
  while (true) {
    TRY(const auto row, reader.Next());
    if (!row) return {};
    const auto page = row->find("page");
    if (page == row->end()) return {};  // no pages were requested
    if (!page->is_string()) continue;
    const fs::path to = fs::path(folder) / page->get<std::string>();
    const fs::path old = from / page->get<std::string>();
    fs::create_directories(to.parent_path(), error);
    fs::remove(to, error);
    fs::create_hard_link(old, to, error);
    if (error) fs::copy_file(old, to, error);
    if (error) return Fail("cannot bring this page along: " + error.message(), old.string());
  }
}

}  // namespace lyrefit
