#include "lyrefit/base/option.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {

// None of the options of this test needs a file or a catalogue.
struct TextReaders {};

enum class Colour { kRed, kBlue };
template <>
struct EnumTable<Colour> {
  static constexpr EnumText<Colour> kRows[] = {{Colour::kRed, "red"}, {Colour::kBlue, "blue"}};
};

namespace {

struct Inner {
  int depth = 1;
  Colour colour = Colour::kRed;
  bool deep = false;
};

struct Paint {
  int coats = 2;
  double litres = 0.5;
  bool dry = true;
  bool glossy = false;
  std::string name = "plain";
  std::optional<int> batch;
  std::vector<std::string> tags;
  Colour colour = Colour::kRed;
  std::optional<Colour> edge;
  std::vector<Colour> stripes = {Colour::kRed};
  int threads = 0;
  Inner inner;
};

constexpr OptionRow<Inner> kInnerTable[] = {{"depth", "", "", &Inner::depth, 0, 9}};
constexpr OptionRow<Paint> kPaintTable[] = {
    OptionRow<Paint>("Paint"),
    {"coats", "", "", &Paint::coats, 1, 5},
    {"litres", "", "", &Paint::litres, OptionTrait::kUnchecked},
    {"dry", "", "", &Paint::dry},
    {"glossy", "", "", &Paint::glossy},
    {"name", "", "", &Paint::name},
    {"batch", "", "", &Paint::batch},
    {"tag", "", "", &Paint::tags},
    {"colour", "", "", EnumOption<&Paint::colour>()},
    {"edge", "", "", EnumOption<&Paint::edge>()},
    {"stripes", "", "", EnumListOption<&Paint::stripes>()},
    {"threads", "", "", &Paint::threads, 0, 9, OptionTrait::kQuiet | OptionTrait::kNoEcho},
    {"inner-colour", "", "", EnumOption<&Paint::inner, &Inner::colour>()},
    {"deep", "", "", SwitchOption<&Paint::inner, &Inner::deep>()},
    {"inner", "", "",
     OptionNest<Paint>{
         [](const Paint& paint, const Paint& defaults, std::vector<OptionEcho>* echoes) {
           AppendNonDefaults(paint.inner, defaults.inner, kInnerTable, echoes);
         }}},
};

std::vector<std::string> Echoes(const Paint& paint) {
  std::vector<std::string> texts;
  for (const OptionEcho& echo : NonDefaults(paint, kPaintTable)) {
    texts.push_back(echo.name + ": " + echo.value + " for " + echo.default_value);
  }
  return texts;
}

constexpr TextReaders kNoReaders{};

const OptionText<Paint>& TextOf(const std::string& name) {
  for (const OptionRow<Paint>& row : kPaintTable) {
    if (row.name == name) return std::get<OptionText<Paint>>(row.field);
  }
  throw std::out_of_range(name);
}

TEST(OptionTable, OfDefaultsEchoesNothing) { EXPECT_TRUE(Echoes({}).empty()); }

TEST(OptionTable, EchoesEveryTypeThatIsNotAtItsDefaultInItsOrder) {
  Paint paint;
  paint.coats = 3;
  paint.litres = 0.25;
  paint.dry = false;
  paint.glossy = true;
  paint.name = "sea";
  paint.batch = 7;
  paint.tags = {"a", "b"};
  paint.colour = Colour::kBlue;
  paint.edge = Colour::kRed;
  paint.stripes = {Colour::kBlue, Colour::kRed};
  paint.threads = 4;  // a row without echo
  paint.inner = {2, Colour::kBlue, true};
  EXPECT_THAT(Echoes(paint),
              ::testing::ElementsAre(
                  "coats: 3 for 2", "litres: 0.25 for 0.5", "dry: no for yes", "glossy: yes for no",
                  "name: sea for plain", "batch: 7 for ", "tag: a for ", "tag: b for ",
                  "colour: blue for red", "edge: red for ", "stripes: blue,red for red",
                  "inner-colour: blue for red", "deep: yes for no", "depth: 2 for 1"));
}

TEST(OptionTable, RefusesNumbersOutsideTheirRangeWhereTheLibraryIsHeldToIt) {
  Paint paint;
  paint.litres = -5;    // its range is not checked here
  paint.threads = 100;  // checked for the command's flag only
  EXPECT_TRUE(ValidateOptions(paint, kPaintTable));
  paint.coats = 6;
  const auto checked = ValidateOptions(paint, kPaintTable);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().message, "coats = 6 is outside [1, 5]");
}

struct Measure {
  double length = 1;
  std::optional<double> width;
};

constexpr OptionRow<Measure> kMeasureTable[] = {{"length", "", "", &Measure::length},
                                                {"width", "", "", &Measure::width, 0, 10}};

TEST(OptionTable, RefusesWhatIsNoNumberAndOptionalNumbersOutsideTheirRange) {
  const auto checked = [](double length, std::optional<double> width) {
    const auto valid = ValidateOptions(Measure{length, width}, kMeasureTable);
    return valid ? "" : valid.error().message;
  };
  EXPECT_EQ(checked(-1e20, std::nullopt), "");
  EXPECT_EQ(checked(1, 10), "");
  EXPECT_EQ(checked(1, 11), "width = 11 is outside [0, 10]");
  EXPECT_EQ(checked(1, kUnknown), "width = nan is outside [0, 10]");
  EXPECT_EQ(checked(kUnknown, 1), "length = nan is outside [-1e+30, 1e+30]");
  EXPECT_EQ(checked(kInfinity, 1), "length = inf is outside [-1e+30, 1e+30]");
  EXPECT_EQ(checked(1e308, 1), "length = 1e+308 is outside [-1e+30, 1e+30]");
}

TEST(OptionTable, ReadsTextsAndSaysWhatItWouldHaveTaken) {
  Paint paint;
  EXPECT_TRUE(TextOf("colour").read("blue", &paint, kNoReaders));
  EXPECT_EQ(paint.colour, Colour::kBlue);
  EXPECT_TRUE(TextOf("edge").read("blue", &paint, kNoReaders));
  EXPECT_EQ(paint.edge, Colour::kBlue);
  EXPECT_TRUE(TextOf("stripes").read("blue,red", &paint, kNoReaders));
  EXPECT_EQ(paint.stripes.size(), 2U);
  EXPECT_EQ(TextOf("colour").allowed(), "red, blue");
  EXPECT_EQ(TextOf("colour").read("green", &paint, kNoReaders).error().message,
            "expected one of red, blue, found 'green'");
  EXPECT_EQ(TextOf("stripes").read("red,green", &paint, kNoReaders).error().message,
            "expected a list of red, blue, found 'green'");
  EXPECT_EQ(TextOf("stripes").read("red,", &paint, kNoReaders).error().message,
            "expected a list such as a,b,c, found 'red,'");
}

}  // namespace
}  // namespace lyrefit
