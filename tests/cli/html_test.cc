#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

const std::string kShipped = LYREFIT_DATA_DIR;

// The JSON record embedded in a page.
nlohmann::json RecordOf(const std::string& html) {
  const std::string begins = "<script type=\"application/json\" id=\"record\">";
  const std::size_t at = html.find(begins);
  if (at == std::string::npos) return nullptr;
  const std::size_t begin = at + begins.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

TEST(Html, OfEveryVerbHoldsItsVerdictAPictureAndItsRecord) {
  SKIP_IF_SANITIZED();
  for (const std::string& verb :
       {"fit " + kShipped + "/rtc_france", "diagnose " + kShipped + "/diagnosis/shaded_module.csv",
        "certify " + kShipped + "/rtc_france",
        "fit " + kShipped + "/s75_constructed --family desoto",
        "compare " + kShipped + "/rtc_france --runs 2 --models sd --iterations 20"}) {
    const TempFolder folder;
    const std::string page = folder.Path("page.html");
    const std::string json = folder.Path("record.json");
    const AppResult result = RunApp(verb + " --quiet --html " + page + " --json " + json);
    ASSERT_EQ(result.exit_code, 0) << verb << "\n" << result.err;
    EXPECT_EQ(result.out, "");
    const std::string html = FileText(page);
    EXPECT_TRUE(html.find("<h2>Verdict</h2>") != std::string::npos) << verb;
    EXPECT_TRUE(html.find("<figure id=\"figure-1\"") != std::string::npos) << verb;
    EXPECT_TRUE(html.find("<svg ") != std::string::npos) << verb;
    EXPECT_EQ(RecordOf(html), nlohmann::json::parse(FileText(json))) << verb;
    EXPECT_LT(html.size(), 1600000u) << verb;
  }
}

TEST(Html, OfSeveralFitsIsTheirTable) {
  const TempFolder folder;
  const std::string page = folder.Path("page.html");
  const std::string files = kShipped + "/rtc_france " + kShipped + "/pwp201";
  ASSERT_EQ(RunApp("fit " + files + " --quiet --html " + page).exit_code, 0);
  const std::string html = FileText(page);
  EXPECT_TRUE(html.find("fits of 2 curves") != std::string::npos);
  EXPECT_EQ(RecordOf(html).size(), 2u);
}

}  // namespace
}  // namespace lyrefit
