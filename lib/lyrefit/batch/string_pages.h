// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Curves of a batch that get a page.
enum class PagesOf {
  kNone,
  kFailed,  // curves that do not pass, show a cause, or are not usable
  kAll,
};

template <>
struct EnumTable<PagesOf> {
  static constexpr EnumText<PagesOf> kRows[] = {
      {PagesOf::kNone, "none"}, {PagesOf::kFailed, "failed"}, {PagesOf::kAll, "all"}};
};

// Path of a curve's page below the folder of the results: "pages/inv01/str07.html". The levels of
// the id are folders. Different ids have different paths, even on file systems that ignore case.
// Bytes other than a-z, A-Z, 0-9, '.', '_' and '-' become "~" and two hexadecimal digits. So do a
// leading dot and the last dot of a level. A level with capital letters ends with "~." and a bit
// mask of their positions in hexadecimal, least significant digit first ("INV01" is "INV01~.7"). A
// level longer than 120 bytes becomes "~_" and a digest of it, 122 bits of SHA-1. The whole id
// becomes a digest if the path would have more than 1000 bytes. No character of a path has to be
// escaped in a link.
std::string StringPagePath(const std::string& id);

// Writes the page, completely or not at all, and creates its folders. Thread-safe.
Expected<void> WriteStringPage(const std::string& folder, const std::string& path,
                               const std::string& html);

// The page that was written, with `lines` at the head of its verdict, in place of those of an
// earlier call; `own` stands above the lines of the page itself. Errors: a missing page.
Expected<void> AddToStringPage(const std::string& folder, const std::string& path,
                               const std::vector<std::string>& lines, const std::string& own);

// Copies the pages named by the rows of the checkpoint file `part` from its folder into `folder`.
// Files on one disk are hard links, else copies. Errors: a missing page.
Expected<void> BringStringPages(const std::string& part, const std::string& folder);

}  // namespace lyrefit
