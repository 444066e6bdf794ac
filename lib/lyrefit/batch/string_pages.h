#pragma once

#include <string>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Which curves of a batch get a page of their own.
enum class PagesOf {
  kNone,
  kFailed,  // that do not pass, show a cause, or have an answer not to be worked with
  kAll,
};

template <>
struct EnumTable<PagesOf> {
  static constexpr EnumText<PagesOf> kRows[] = {
      {PagesOf::kNone, "none"}, {PagesOf::kFailed, "failed"}, {PagesOf::kAll, "all"}};
};

// Where the page of a curve stands below the folder of the results: "pages/inv01/str07.html". The
// levels of the id are folders. No two ids have one path, not even where file systems do not tell
// A from a: beside a-z, 0-9, '.', '_' and '-' a byte is "~" and its two hexadecimal digits, and a
// level with capital letters ends with "~" and the letters' places as a hexadecimal number ("INV01"
// is "INV01~.7"). A level whose name would have more than 120 bytes is "~_" and a digest of it, 122
// bits of SHA-1; so is the whole id where the path would have more than 1000. Nothing in a path has
// to be escaped in a link.
std::string StringPagePath(const std::string& id);

// Writes the page, whole or not at all, and makes its folders. From any thread.
Expected<void> WriteStringPage(const std::string& folder, const std::string& path,
                               const std::string& html);

// The pages that rows of the part file name, from one folder into another: links to the same file
// where both are on one disk, else copies. Errors: a page that is not there.
Expected<void> BringStringPages(const std::string& part, const std::string& folder);

}  // namespace lyrefit
