#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "cases.h"
#include "lyrefit/stream/row_names.h"
#include "read/told.h"

namespace lyrefit {
namespace {

TEST(ParseList, TakesEverySeparator) {
  CheckCases("batch_lists",
             {{"list",
               [](const std::string& text) {
                 Record list;
                 ParseList(text, 7, &list);
                 std::string told = IsList(text) ? "" : "no list; ";
                 told += Numbers(list.values);
                 if (list.bad.empty()) return told;
                 return told + fmt::format("; '{}' at {}, column {}, {}", list.bad, list.bad_at,
                                           list.bad_column, list.bad_is_text ? "text" : "missing");
               }},
              {"pairs", [](const std::string& text) {
                 Records fields;
                 std::string told = ParsePairs(text, 1, &fields) ? "" : "none";
                 for (const auto& list : fields.lists) {
                   told += (told.empty() ? "" : "; ") + list.name + " " + Numbers(list.values);
                 }
                 return told;
               }}});
}

}  // namespace
}  // namespace lyrefit
