#include "platform/text.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "platform/named_entries.h"

namespace gpu_shading::energyplus {
namespace {

// The pattern by the standard library's own regular expressions.
bool reference(std::string const& pattern, std::string const& name) {
  std::string expression;
  for (char const letter : pattern) expression += letter == '*' ? ".*" : std::string(1, letter);
  return std::regex_match(name, std::regex(expression, std::regex::icase));
}

TEST(Text, MistypedWordHasANearOne) {
  std::vector<std::string> const words{"devices", "check", "view", "sample", "export"};
  for (auto const* const near : {"veiw", "iew", "vieww", "vlew", "View"}) {
    EXPECT_EQ(did_you_mean(near, words), "; did you mean view?") << near;
  }
  EXPECT_EQ(did_you_mean("exprot", words), "; did you mean export?");
  EXPECT_EQ(did_you_mean("Exprot", words), "; did you mean export?");
  EXPECT_EQ(did_you_mean("west windwo", {"WEST WINDOW"}), "; did you mean WEST WINDOW?");
  EXPECT_EQ(did_you_mean("divces", words), "; did you mean devices?");
  for (auto const* const far : {"", "x", "run", "weave", "simple_check"}) {
    EXPECT_EQ(did_you_mean(far, words), "") << far;
  }
}

TEST(Text, PatternsMatchAsRegularExpressionsDo) {
  std::mt19937 random(1);
  auto const word = [&](std::string const& letters, std::size_t most) {
    std::string text;
    for (auto left = random() % (most + 1); left > 0; --left) {
      text += letters[random() % letters.size()];
    }
    return text;
  };
  int matched = 0;
  for (int i = 0; i < 5000; ++i) {
    auto const pattern = word("ab**", 8);
    auto const name = word("abB", 10);
    ASSERT_EQ(matches(pattern, name), reference(pattern, name)) << pattern << ' ' << name;
    matched += matches(pattern, name) ? 1 : 0;
  }
  EXPECT_GT(matched, 500);
  EXPECT_LT(matched, 4500);
}

TEST(Text, ManyStarsTakeNoTime) {
  std::string const name(200, 'a');
  auto const began = std::chrono::steady_clock::now();
  EXPECT_FALSE(matches("a*a*a*a*a*a*a*a*b", name));
  // Microseconds; every way to share the letters out would take hours.
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(100));
}

TEST(Text, NumbersAreFinite) {
  EXPECT_EQ(parse_number("+1e3"), 1000.0);
  for (auto const* const text : {"inf", "-inf", "nan", "infinity", "1e999", "", "1 2", "+-1"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
  }
}

TEST(Text, CsvFieldsAreNoFormulas) {
  EXPECT_EQ(csv_quoted("A \"1\""), "\"A \"\"1\"\"\"");
  for (auto const* const formula : {"=1+1", "+A1", "-A1", "@SUM(1)", "\t=1"}) {
    EXPECT_EQ(csv_quoted(formula), std::string("\"'") + formula + '"');
    EXPECT_EQ(csv_field(formula), csv_quoted(formula));
  }
  EXPECT_EQ(csv_quoted("-1.5e3"), "\"-1.5e3\"");
  EXPECT_EQ(csv_field("-1.5e3"), "-1.5e3");
  EXPECT_EQ(csv_field("WALL 1"), "WALL 1");
  EXPECT_EQ(csv_field("A,B"), "\"A,B\"");
}

TEST(Text, AMessageIsOneLine) {
  EXPECT_EQ(one_line("a:\n  b\n\n  c\n"), "a: b c");
  EXPECT_EQ(one_line("bell \a, escape \x1b[31m, \xc2\x9b, r\xc3\xa9sum\xc3\xa9"),
            "bell \\x07, escape \\x1b[31m, \\xc2\\x9b, r\xc3\xa9sum\xc3\xa9");
  auto const cut = one_line("model.idf: " + std::string(5000, 'x') + ", expected a number");
  EXPECT_LT(cut.size(), 2100U);
  EXPECT_TRUE(cut.starts_with("model.idf: x"));
  EXPECT_TRUE(cut.ends_with("x, expected a number"));
  EXPECT_EQ(printable("a\nb"), "a\\nb");
}

TEST(MarkupText, ClosesNoTagAndIsUtf8) {
  EXPECT_EQ(markup_text("a</title>&\"b\"\n\xe9"), "a&lt;/title&gt;&amp;&quot;b&quot;?\xef\xbf\xbd");
  EXPECT_EQ(markup_text("S\xc3\xbc"
                        "d"),
            "S\xc3\xbc"
            "d");
}

TEST(Text, EntriesAreFoundByTheirPatterns) {
  std::mt19937 random(2);
  std::map<std::string, int> entries;
  auto const name = [&](std::string const& letters) {
    std::string text;
    for (auto left = random() % 6; left > 0; --left) text += letters[random() % letters.size()];
    return text;
  };
  for (int i = 0; i < 300; ++i) entries.emplace(name("ABC"), i);
  for (int i = 0; i < 300; ++i) {
    auto const pattern = name("aBc**");
    std::vector<std::string> found;
    std::vector<std::string> expected;
    for_each_match(entries, pattern, [&](auto const& entry) { found.push_back(entry.first); });
    for (auto const& [entry, number] : entries) {
      if (matches(pattern, entry)) expected.push_back(entry);
    }
    EXPECT_EQ(found, expected) << pattern;
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
